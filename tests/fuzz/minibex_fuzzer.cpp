// SPDX-License-Identifier: Apache-2.0
// Any bytes as a Minibex file, through the whole compile path and a moment of propagation.
#include <cstdint>
#include <string>

#include "lang/lang.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto compilation = hcsp::lang::compile_text({"system.bch", text});
  static_cast<void>(compilation.diagnostics.text());
  if (!compilation.model) return 0;
  hcsp::PropagationOptions options;
  options.time_limit = 0.05;
  options.explain = false;
  static_cast<void>(compilation.model->problem->propagate(options));
  return 0;
}
