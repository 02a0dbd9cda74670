// SPDX-License-Identifier: Apache-2.0
// The order of code: steps of one kind side by side where their operands allow it. A run of them is executed
// with one dispatch, and on operands that do not wait for each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace hcsp::online {

/// An order of steps y = kind(a, b, c) in which every one comes after those that compute its operands.
template <class Step, class KindOf>
std::vector<std::size_t> schedule(const std::vector<Step>& steps, KindOf kind_of) {
  std::map<std::uint32_t, std::size_t> producer;
  for (std::size_t i = 0; i < steps.size(); ++i) producer[steps[i].y] = i;
  std::vector<std::size_t> waits_for(steps.size()), order;
  std::vector<std::vector<std::size_t>> users(steps.size());
  std::map<decltype(kind_of(steps[0])), std::vector<std::size_t>> ready;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const std::uint32_t operand : {steps[i].a, steps[i].b, steps[i].c}) {
      const auto by = producer.find(operand);
      if (by == producer.end()) continue;
      users[by->second].push_back(i);
      ++waits_for[i];
    }
    if (waits_for[i] == 0) ready[kind_of(steps[i])].push_back(i);
  }
  // All that is ready of one kind, then of the one that has most.
  while (order.size() < steps.size()) {
    const auto most = std::max_element(ready.begin(), ready.end(), [](const auto& a, const auto& b) {
      return a.second.size() < b.second.size();
    });
    for (std::vector<std::size_t>& own = most->second; !own.empty();) {
      const auto next = std::min_element(own.begin(), own.end());
      const std::size_t i = *next;
      own.erase(next);
      order.push_back(i);
      for (const std::size_t user : users[i]) {
        if (--waits_for[user] == 0) ready[kind_of(steps[user])].push_back(user);
      }
    }
  }
  return order;
}

/// The steps from the first on in that order.
template <class Step, class KindOf>
void reorder(std::vector<Step>& steps, std::size_t first, KindOf kind_of) {
  const std::vector<Step> before(steps.begin() + static_cast<std::ptrdiff_t>(first), steps.end());
  for (const std::size_t from : schedule(before, kind_of)) steps[first++] = before[from];
}

}  // namespace hcsp::online
