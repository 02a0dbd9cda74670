// SPDX-License-Identifier: Apache-2.0
// A search tree explored on all cores, depth first or best first, with limits, and moments of rest at which
// what is open and what was found can be kept.
//
// An Explorer has a type Node and `void explore(Node& node, std::vector<Node>& children)`, which appends the
// node's children in the order to be explored in. Each thread has an explorer of its own, which keeps what it
// finds itself and needs no locks. To be explored best first, a Node has a `double priority`: least first.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

#include "domains/rounding.h"
#include "solver/search/search_options.h"

namespace hcsp {

template <class Explorer>
class TreeSearch {
 public:
  using Node = typename Explorer::Node;
  using Nodes = std::vector<Node>;

  /// `make_explorer` is called once for each thread that takes part, perhaps at the same time.
  template <class Factory>
  TreeSearch(const SearchOptions& options, Factory make_explorer)
      : options_(options),
        threads_(static_cast<int>(std::max(options.threads, 1U))),
        started_(options.clock()),
        explorers_(std::move(make_explorer)) {}

  /// Explores some nodes and all that come of them, on threads that round upward. Every checkpoint period no
  /// node is at work for a moment, and at_rest() is called with those that are open. False when a limit or
  /// `cancel` stopped it: then open() is what was left.
  bool run(Nodes roots, const std::function<void(const Nodes&)>& at_rest = {}) {
    open_ = std::move(roots);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads_));
    tbb::task_arena arena(threads_);
    double period = options_.checkpoint_period;
    while (!open_.empty() && !is_stopped()) {
      next_rest_ = at_rest ? options_.clock() + period : 0.0;
      arena.execute([&] { explore_until_rest(); });
      if (!at_rest) continue;
      const double rested = options_.clock();
      at_rest(open_);
      period = std::max(options_.checkpoint_period, kWorkToRest * (options_.clock() - rested));
    }
    return open_.empty();
  }

  /// The nodes that are open at rest, or after a run that was stopped.
  [[nodiscard]] const Nodes& open() const { return open_; }
  /// The explorers of all threads, at rest or after a run.
  auto& explorers() { return explorers_; }

 private:
  static constexpr double kWorkToRest = 20.0;  // what is kept may have grown large

  [[nodiscard]] bool is_stopped() const {
    if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) return true;
    return options_.time_limit > 0 && options_.clock() - started_ >= options_.time_limit;
  }
  [[nodiscard]] bool is_to_rest() const {
    return is_stopped() || (next_rest_ > 0 && options_.clock() >= next_rest_);
  }

  void explore_until_rest() {
    tbb::task_group tasks;
    active_ = 1;
    if constexpr (requires(Node node) { node.priority; }) {
      if (options_.order == SearchOrder::best_first) {
        std::make_heap(open_.begin(), open_.end(), comes_later);
        return void(tasks.run_and_wait([&] { take_best(tasks); }));
      }
    }
    Nodes stack;
    stack.swap(open_);
    tasks.run_and_wait([&] { descend(tasks, stack); });
  }

  // Whether a task more would have a thread; then it is counted.
  bool claims_thread() {
    int active = active_.load(std::memory_order_relaxed);
    while (active < threads_) {
      if (active_.compare_exchange_weak(active, active + 1, std::memory_order_relaxed)) return true;
    }
    return false;
  }

  void explore(Node& node, Nodes& children) {
    children.clear();
    explorers_.local().explore(node, children);
    if (options_.progress == nullptr) return;
    options_.progress->cells.fetch_add(1, std::memory_order_relaxed);
    options_.progress->open.fetch_add(static_cast<std::int64_t>(children.size()) - 1,
                                      std::memory_order_relaxed);
  }

  // The deepest node first; who has no work is given the shallowest, which has most below it.
  void descend(tbb::task_group& tasks, Nodes& stack) {
    const RoundUpward guard;
    Nodes children;
    while (!stack.empty()) {
      if (is_to_rest()) {
        const std::lock_guard lock(mutex_);
        std::move(stack.begin(), stack.end(), std::back_inserter(open_));
        break;
      }
      if (stack.size() > 1 && claims_thread()) {
        auto given = std::make_shared<Nodes>();
        given->push_back(std::move(stack.front()));
        stack.erase(stack.begin());
        tasks.run([this, &tasks, given] { descend(tasks, *given); });
      }
      Node node = std::move(stack.back());
      stack.pop_back();
      explore(node, children);
      std::move(children.rbegin(), children.rend(), std::back_inserter(stack));
    }
    --active_;
  }

  static bool comes_later(const Node& a, const Node& b) { return a.priority > b.priority; }

  void take_best(tbb::task_group& tasks) {
    const RoundUpward guard;
    Nodes children;
    std::unique_lock lock(mutex_);
    while (!open_.empty() && !is_to_rest()) {
      std::pop_heap(open_.begin(), open_.end(), comes_later);
      Node node = std::move(open_.back());
      open_.pop_back();
      lock.unlock();
      explore(node, children);
      lock.lock();
      for (Node& child : children) {
        open_.push_back(std::move(child));
        std::push_heap(open_.begin(), open_.end(), comes_later);
      }
      if (open_.size() > 1 && claims_thread()) tasks.run([this, &tasks] { take_best(tasks); });
    }
    --active_;
  }

  const SearchOptions& options_;
  int threads_;
  double started_, next_rest_ = 0.0;
  std::atomic<int> active_ = 0;  // tasks at work
  std::mutex mutex_;             // of open_, while tasks are at work
  Nodes open_;
  tbb::enumerable_thread_specific<Explorer> explorers_;
};

}  // namespace hcsp
