// SPDX-License-Identifier: Apache-2.0
// The operations of the interval test language in terms of the library.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/conformance/itl_reader.h"

namespace hcsp::itl {

struct Outcome {
  std::vector<Value> results;
  /// The library says that the operation is undefined: it throws, where the standard signals.
  bool is_undefined = false;
};

struct Operation {
  /// Throws std::bad_variant_access or std::out_of_range where the operands do not fit.
  std::function<Outcome(const std::vector<Value>&)> run;
  /// A reverse operation may be an ulp wider a side.
  bool is_reverse = false;
};

/// By their names in ITF1788.
const std::map<std::string, Operation>& operations();

}  // namespace hcsp::itl
