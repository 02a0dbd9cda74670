// SPDX-License-Identifier: Apache-2.0
// The order of code: steps of one kind side by side where their operands allow it. A run of them is executed
// with one dispatch, and on operands that do not wait for each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <type_traits>
#include <vector>

namespace hcsp::online {

template <class Step, class KindOf>
class Scheduler {
 public:
  Scheduler(const std::vector<Step>& steps, KindOf kind_of)
      : waits_for_(steps.size()), users_(steps.size()), changes_(steps.size()) {
    std::map<std::uint32_t, std::size_t> producer;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      kinds_.push_back(kind_of(steps[i]));
      ++left_[kinds_[i]];
      producer[steps[i].y] = i;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      for (const std::uint32_t operand : {steps[i].a, steps[i].b, steps[i].c}) {
        const auto by = producer.find(operand);
        if (by == producer.end()) continue;
        users_[by->second].push_back(i);
        ++waits_for_[i];
      }
      if (waits_for_[i] == 0) ready_[kinds_[i]].insert(i);
    }
    for (std::size_t i = steps.size(); i-- > 0;) {
      for (const std::size_t user : users_[i])
        changes_[i] = std::max(changes_[i], changes_[user] + (kinds_[user] == kinds_[i] ? 0U : 1U));
    }
  }

  std::vector<std::size_t> order() {
    while (order_.size() < kinds_.size()) take_all_of(next_kind());
    return std::move(order_);
  }

 private:
  using Kind = std::invoke_result_t<KindOf, const Step&>;

  // One of which nothing is left to wait for, else the one that most changes of kind wait for.
  Kind next_kind() const {
    const auto priority = [&](const auto& own) {
      const std::set<std::size_t>& ready = own.second;
      std::size_t changes = 0;
      for (const std::size_t i : ready) changes = std::max(changes, changes_[i]);
      return std::tuple(!ready.empty(), ready.size() == left_.at(own.first), changes, ready.size());
    };
    return std::ranges::max_element(ready_, {}, priority)->first;
  }

  void take_all_of(Kind kind) {
    for (std::set<std::size_t>& own = ready_[kind]; !own.empty();) {
      const std::size_t i = *own.begin();
      own.erase(own.begin());
      order_.push_back(i);
      --left_[kind];
      for (const std::size_t user : users_[i]) {
        if (--waits_for_[user] == 0) ready_[kinds_[user]].insert(user);
      }
    }
  }

  // By step: its kind, how many operands are still to come, what reads it, and how many changes of kind are
  // at least behind it.
  std::vector<Kind> kinds_;
  std::vector<std::size_t> waits_for_;
  std::vector<std::vector<std::size_t>> users_;
  std::vector<std::size_t> changes_;
  std::map<Kind, std::set<std::size_t>> ready_;
  std::map<Kind, std::size_t> left_;
  std::vector<std::size_t> order_;
};

/// An order of steps y = kind(a, b, c) of which every one comes after those that compute its operands, as it
/// does already, in runs of one kind that are few.
template <class Step, class KindOf>
std::vector<std::size_t> schedule(const std::vector<Step>& steps, KindOf kind_of) {
  return Scheduler(steps, kind_of).order();
}

/// The steps from the first on in that order.
template <class Step, class KindOf>
void reorder(std::vector<Step>& steps, std::size_t first, KindOf kind_of) {
  const std::vector<Step> before(steps.begin() + static_cast<std::ptrdiff_t>(first), steps.end());
  for (const std::size_t from : schedule(before, kind_of)) steps[first++] = before[from];
}

}  // namespace hcsp::online
