// SPDX-License-Identifier: Apache-2.0
// A thread beside a run that stops it at a limit of memory and shows how far a search has come.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "solver/search/search_options.h"

namespace hcsp::tool {

/// While it lives, it sets `stop` when the process holds more than `megabytes` of memory (0: no limit), and
/// writes the progress of a search, if there is one, to the standard error output.
class Watch {
 public:
  Watch(double megabytes, std::atomic<bool>& stop, const SearchProgress* shown);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch();

 private:
  void run();
  void show();

  double megabytes_;
  std::atomic<bool>& stop_;
  const SearchProgress* shown_;
  double started_;
  bool over_ = false;
  bool has_shown_ = false;
  std::mutex mutex_;
  std::condition_variable end_;
  std::thread thread_;
};

}  // namespace hcsp::tool
