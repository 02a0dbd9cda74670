// SPDX-License-Identifier: Apache-2.0
// A program outside the project: adds two intervals with the installed library.
#include <cstdio>

#include "domains/interval/interval.h"

int main() {
  const hcsp::Interval sum = hcsp::Interval(1, 2) + hcsp::Interval::of_decimal("0.5");
  std::printf("[1, 2] + 0.5 = %s\n", hcsp::to_string(sum).c_str());
  return sum == hcsp::Interval(1.5, 2.5) ? 0 : 1;
}
