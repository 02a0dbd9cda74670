// SPDX-License-Identifier: Apache-2.0
// Whether vectors that are known within a tolerance can be collinear: docs/straight_line.md, "Straight, of
// rounded numbers", in arithmetic of its own.
#pragma once

#include <optional>
#include <string>

#include "tests/straight_line/move.h"

namespace hcsp::straight_line {

/// Two vectors ("d" is p1 - p0) and two joints, counted from 1, whose minor cannot vanish.
struct Refutation {
  std::string m, n;
  std::size_t k, l;
};
/// Some refutation if there is one. None proves nothing when more than two vectors are not zero.
std::optional<Refutation> refutation(const Move& move);

}  // namespace hcsp::straight_line
