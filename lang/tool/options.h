// SPDX-License-Identifier: Apache-2.0
// The command line of hcsp-solve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lang/lang.h"

namespace hcsp::tool {

struct Options {
  std::string model;
  lang::CompileOptions compile;
  std::vector<std::string> outputs;
  unsigned threads = 1;
  double time_limit = 0.0;
  double memory_limit = 0.0;  // megabytes; 0 is none
  double precision = 0.0;     // of the model where 0
  std::optional<SearchOrder> order;
  Bisector bisector = Bisector::smear;
  std::string checkpoint;
  std::string resume;
  std::vector<std::string> of_search;  // those given that only a search can make use of
  bool check_only = false;
  bool format = false;
  bool quiet = false;
  std::string explain;
  std::string dump;
  std::string graph;
  std::string trace;
  std::string truth;
};

/// The options, or the status to exit with: 0 after --help and --version, 2 after wrong usage, which is
/// printed.
struct ParsedOptions {
  std::optional<Options> options;
  int status = 0;
};
ParsedOptions parse_options(int argc, char** argv);

/// The part of a path from its last dot, in lower case.
std::string extension(const std::string& path);

}  // namespace hcsp::tool
