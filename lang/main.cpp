// SPDX-License-Identifier: Apache-2.0
// hcsp-solve MODEL.hcsp: solves a model and writes the answer.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "lang/tool/run.h"

int main(int argc, char** argv) {
  try {
    const auto parsed = hcsp::tool::parse_options(argc, argv);
    return parsed.options ? hcsp::tool::run(*parsed.options) : parsed.status;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "hcsp-solve: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "hcsp-solve: internal error: {}\n", error.what());
  }
  return hcsp::tool::kStopped;
}
