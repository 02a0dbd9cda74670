// SPDX-License-Identifier: Apache-2.0
#include "lang/tool/watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

namespace hcsp::tool {

namespace {

// What the process holds in memory, as Linux counts it (proc(5), statm).
double resident_megabytes() {
  std::ifstream counts("/proc/self/statm");
  double total = 0, resident = 0;
  counts >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace

Watch::Watch(double megabytes, std::atomic<bool>& stop, const SearchProgress* shown)
    : megabytes_(megabytes), stop_(stop), shown_(shown), started_(steady_clock()()) {
  if (megabytes > 0 || shown != nullptr) thread_ = std::thread([this] { run(); });
}

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  end_.notify_one();
  if (thread_.joinable()) thread_.join();
  if (has_shown_) fmt::print(stderr, "\r\033[K");
}

void Watch::run() {
  constexpr auto kPeriod = std::chrono::milliseconds(20);
  constexpr int kPeriodsAShow = 25;
  std::unique_lock lock(mutex_);
  for (int period = 1; !end_.wait_for(lock, kPeriod, [&] { return over_; }); ++period) {
    if (megabytes_ > 0 && resident_megabytes() > megabytes_) stop_ = true;
    if (shown_ != nullptr && period % kPeriodsAShow == 0) show();
  }
}

void Watch::show() {
  has_shown_ = true;
  fmt::print(stderr, "\r{} cells, {} open, {:.1f} s\033[K", shown_->cells.load(), shown_->open.load(),
             steady_clock()() - started_);
}

}  // namespace hcsp::tool
