// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/collinear.h"

#include <map>

#include "tests/verifier/precise.h"

namespace hcsp::straight_line {

std::optional<Refutation> refutation(const Move& move) {
  using verifier::Precise;
  const Precise play = Precise(1) + Precise(-move.tol, move.tol);
  std::map<std::string, std::vector<Precise>> boxes;
  for (const std::string& name : vectors_of(move.type)) {
    if (name == "p0") continue;
    std::vector<Precise>& box = boxes[name == "p1" ? "d" : name];
    for (std::size_t k = 0; k < move.joints(); ++k) {
      const Precise x = Precise((*move.parameter(name))[k]) * play;
      box.push_back(name == "p1" ? x - Precise(move.p0[k]) * play : x);
    }
  }
  for (const auto& [m, a] : boxes) {
    for (const auto& [n, b] : boxes) {
      for (std::size_t k = 0; m < n && k < move.joints(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {
          if (!(a[k] * b[l] - a[l] * b[k]).meets(0.0)) return Refutation{m, n, k + 1, l + 1};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace hcsp::straight_line
