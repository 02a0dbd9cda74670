// SPDX-License-Identifier: Apache-2.0
// What pages and pictures show besides the result itself: the order of the variables, and the truth when it
// is known.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/result.h"

namespace hcsp {

/// True trajectories: for every tube that the file knows, one row of components an instant of t.
struct Truth {
  std::vector<double> t;
  std::map<std::string, std::vector<std::vector<double>>> tubes;
};

struct Presentation {
  std::vector<std::string> shown;  ///< the variables to show, in order; none means all
  std::optional<Truth> truth;
};

/// Reads a truth from the text of a CSV file: a column t, and for a tube x of dimension 2 the columns x1 and
/// x2, or x[1] and x[2]; for one of dimension 1, x. Columns that name no tube of the result are ignored. On
/// failure nothing, and `error` says what is wrong and in which line.
std::optional<Truth> read_truth(std::string_view csv_text, const Result& result, std::string& error);

}  // namespace hcsp
