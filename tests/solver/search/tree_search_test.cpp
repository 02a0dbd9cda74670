// SPDX-License-Identifier: Apache-2.0
#include "solver/search/tree_search.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace hcsp {
namespace {

// Counts to a depth: each node has two children, and is known by its place in the tree.
class Counter {
 public:
  struct Node {
    std::uint32_t place = 1;
    double priority = 0.0;
  };
  explicit Counter(std::uint32_t end, std::atomic<bool>* cancel = nullptr, std::uint32_t cancel_at = 0)
      : end_(end), cancel_(cancel), cancel_at_(cancel_at) {}
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  void explore(Node& node, std::vector<Node>& children) {
    found.push_back(node.place);
    if (node.place == cancel_at_) *cancel_ = true;
    for (const std::uint32_t child : {2 * node.place, 2 * node.place + 1}) {
      if (child < end_) children.push_back({child, -static_cast<double>(child % 7)});
    }
  }
  std::vector<std::uint32_t> found;

 private:
  std::uint32_t end_;
  std::atomic<bool>* cancel_;
  std::uint32_t cancel_at_;
};

constexpr std::uint32_t kEnd = 1U << 14;

std::vector<std::uint32_t> all_found(TreeSearch<Counter>& search) {
  std::vector<std::uint32_t> all;
  for (const Counter& counter : search.explorers())
    all.insert(all.end(), counter.found.begin(), counter.found.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::uint32_t> every_place() {
  std::vector<std::uint32_t> all(kEnd - 1);
  std::iota(all.begin(), all.end(), 1U);
  return all;
}

TEST(TreeSearch, ExploresEveryNodeOnceInAnyOrderOnAnyNumberOfThreads) {
  for (const SearchOrder order : {SearchOrder::depth_first, SearchOrder::best_first}) {
    for (const unsigned threads : {1U, 2U, 5U}) {
      SearchOptions options;
      options.order = order;
      options.threads = threads;
      TreeSearch<Counter> search(options, [] { return Counter(kEnd); });
      EXPECT_TRUE(search.run({{}}));
      EXPECT_TRUE(search.open().empty());
      EXPECT_EQ(all_found(search), every_place());
    }
  }
}

TEST(TreeSearch, OneThreadGoesDownFirstOrTakesTheBest) {
  SearchOptions options;
  TreeSearch<Counter> depth(options, [] { return Counter(16); });
  depth.run({{}});
  EXPECT_EQ(depth.explorers().begin()->found,
            (std::vector<std::uint32_t>{1, 2, 4, 8, 9, 5, 10, 11, 3, 6, 12, 13, 7, 14, 15}));
  options.order = SearchOrder::best_first;
  TreeSearch<Counter> best(options, [] { return Counter(8); });
  best.run({{}});
  EXPECT_EQ(best.explorers().begin()->found, (std::vector<std::uint32_t>{1, 3, 6, 2, 5, 4, 7}));
}

TEST(TreeSearch, WhatIsOpenAtACancelIsAllThatWasNotExplored) {
  for (const SearchOrder order : {SearchOrder::depth_first, SearchOrder::best_first}) {
    for (const unsigned threads : {1U, 3U}) {
      std::atomic<bool> cancel = false;
      SearchOptions options;
      options.order = order;
      options.threads = threads;
      options.cancel = &cancel;
      TreeSearch<Counter> search(options, [&] { return Counter(kEnd, &cancel, 97); });
      EXPECT_FALSE(search.run({{}}));
      cancel = false;
      const auto before = all_found(search);
      EXPECT_LT(before.size(), every_place().size());
      TreeSearch<Counter> rest(options, [] { return Counter(kEnd); });
      EXPECT_TRUE(rest.run(search.open()));
      auto all = all_found(rest);
      all.insert(all.end(), before.begin(), before.end());
      std::sort(all.begin(), all.end());
      EXPECT_EQ(all, every_place());
    }
  }
}

TEST(TreeSearch, AtRestNothingIsLostOrTwice) {
  for (const SearchOrder order : {SearchOrder::depth_first, SearchOrder::best_first}) {
    SearchOptions options;
    options.order = order;
    options.threads = 2;
    options.checkpoint_period = 1e-6;
    int rests = 0;
    TreeSearch<Counter> search(options, [] { return Counter(kEnd); });
    const bool ended = search.run({{}}, [&](const auto& open) {
      if (++rests % 50 != 1) return;
      std::set<std::uint32_t> known;
      for (const std::uint32_t place : all_found(search)) EXPECT_TRUE(known.insert(place).second);
      for (const auto& node : open) EXPECT_TRUE(known.insert(node.place).second);
    });
    EXPECT_TRUE(ended);
    EXPECT_GT(rests, 10);
    EXPECT_EQ(all_found(search), every_place());
  }
}

TEST(TreeSearch, TellsItsProgress) {
  SearchProgress progress;
  SearchOptions options;
  options.progress = &progress;
  TreeSearch<Counter> search(options, [] { return Counter(100); });
  search.run({{}});
  EXPECT_EQ(progress.cells, 99U);
  EXPECT_EQ(progress.open, -1);
}

}  // namespace
}  // namespace hcsp
