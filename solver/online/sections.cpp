// SPDX-License-Identifier: Apache-2.0
#include "solver/online/sections.h"

#include <algorithm>
#include <map>
#include <optional>

#include "solver/online/schedule.h"

namespace hcsp::online {

namespace {

constexpr std::size_t kMany = 128;  // steps that wait for a guard: for less it is not worth a look

class Sectioner {
 public:
  Sectioner(std::vector<Instruction> code, const std::set<Register>& is_read) : code_(std::move(code)) {
    for (std::size_t i = 0; i < code_.size(); ++i) producer_[code_[i].y] = i;
    find_guards(is_read);
    choose_guards();
  }

  std::vector<Section> sections() {
    std::vector<Section> result;
    const std::set<std::vector<Guard>> all(chosen_.begin(), chosen_.end());
    is_done_.resize(code_.size());
    for (std::size_t done = 0; done < code_.size();) {
      for (const std::vector<Guard>& guards : all) {
        std::vector<Instruction> ready = take_ready(guards);
        done += ready.size();
        if (ready.empty()) continue;
        reorder(ready, 0, [](const Instruction& at) { return at.op; });
        result.push_back({guards, std::move(ready)});
      }
    }
    return result;
  }

 private:
  // Of each step, what all that read it wait for.
  void find_guards(const std::set<Register>& is_read) {
    std::vector<std::optional<std::set<Guard>>> of_readers(code_.size());
    guards_.resize(code_.size());
    for (std::size_t i = code_.size(); i-- > 0;) {
      const Instruction& at = code_[i];
      if (of_readers[i] && !is_read.contains(at.y)) guards_[i] = *of_readers[i];
      const auto add = [&](Register reg, std::optional<Guard> own) {
        const auto place = producer_.find(reg);
        if (place == producer_.end()) return;
        std::set<Guard> all = guards_[i];
        if (own) all.insert(*own);
        std::optional<std::set<Guard>>& known = of_readers[place->second];
        if (known) std::erase_if(*known, [&](const Guard& guard) { return !all.contains(guard); });
        if (!known) known = std::move(all);
      };
      const auto alternative = [&](bool wanted) {
        return at.op == Op::if_then_else ? std::optional(Guard{at.a, wanted}) : std::nullopt;
      };
      add(at.a, {});
      if (at.arity > 1) add(at.b, alternative(true));
      if (at.arity > 2) add(at.c, alternative(false));
    }
  }

  // What waits for a Boolean waits for all that the Boolean waits for.
  void choose_guards() {
    std::map<Guard, std::size_t> counts;
    for (const std::set<Guard>& all : guards_) {
      for (const Guard& guard : all) ++counts[guard];
    }
    const auto depth = [&](const Guard& guard) {
      const auto place = producer_.find(guard.boolean);
      return place == producer_.end() ? 0 : guards_[place->second].size();
    };
    for (const std::set<Guard>& all : guards_) {
      std::vector<Guard>& chosen = chosen_.emplace_back();
      std::ranges::copy_if(all, std::back_inserter(chosen),
                           [&](const Guard& guard) { return counts[guard] >= kMany; });
      std::ranges::stable_sort(chosen, {}, depth);
    }
  }

  std::vector<Instruction> take_ready(const std::vector<Guard>& guards) {
    const bool are_available =
        std::ranges::all_of(guards, [&](const Guard& guard) { return is_available(guard.boolean); });
    std::vector<Instruction> ready;
    for (std::size_t i = 0; are_available && i < code_.size(); ++i) {
      const Instruction& at = code_[i];
      const bool is_own = !is_done_[i] && chosen_[i] == guards;
      if (!is_own || !is_available(at.a) || !is_available(at.b) || !is_available(at.c)) continue;
      is_done_[i] = true;
      ready.push_back(at);
    }
    return ready;
  }

  [[nodiscard]] bool is_available(Register reg) const {
    const auto place = producer_.find(reg);
    return place == producer_.end() || is_done_[place->second];
  }

  std::vector<Instruction> code_;
  std::map<Register, std::size_t> producer_;
  std::vector<std::set<Guard>> guards_;     // by step
  std::vector<std::vector<Guard>> chosen_;  // by step
  std::vector<bool> is_done_;
};

}  // namespace

std::vector<Section> sections_of(std::vector<Instruction> code, const std::set<Register>& is_read) {
  return Sectioner(std::move(code), is_read).sections();
}

}  // namespace hcsp::online
