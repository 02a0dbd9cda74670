// SPDX-License-Identifier: Apache-2.0
// Any bytes as a model: they are read or refused with diagnostics; what can be read has a layout, which is
// its own layout and has the same syntax tree.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "lang/syntax/format.h"
#include "lang/syntax/parser.h"

namespace {

std::string tree_of(const std::string& text) {
  hcsp::lang::SyntaxTree tree;
  hcsp::lang::Diagnostics diagnostics;
  hcsp::lang::parse_items(tree.add_source("model.hcsp", text), tree, diagnostics);
  static_cast<void>(diagnostics.text());
  return hcsp::lang::dump(tree);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string tree = tree_of(text);
  const hcsp::lang::Source source("model.hcsp", text);
  hcsp::lang::Diagnostics diagnostics;
  const auto once = hcsp::lang::format(source, diagnostics);
  if (!once) return 0;
  const hcsp::lang::Source again("model.hcsp", *once);
  const auto twice = hcsp::lang::format(again, diagnostics);
  if (twice != once || tree_of(*once) != tree) std::abort();
  return 0;
}
