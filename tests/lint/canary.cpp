// SPDX-License-Identifier: Apache-2.0
// Breaks one rule of each group that .clang-tidy turns on: the lint tests fail unless every one is reported.
#include <string>
#include <utility>

struct bad_type_name {  // readability-identifier-naming
  int value = 0;
};

class Canary {
 public:
  int BadFunctionName() const { return value; }  // readability-identifier-naming

 private:
  int value = 0;  // readability-identifier-naming: a private member without its trailing _
};

const int bad_constant = 3;  // readability-identifier-naming

std::string use_after_move(std::string text) {
  const std::string moved = std::move(text);
  return text + moved;  // bugprone-use-after-move
}

std::size_t length(const std::string text) { return text.size(); }  // performance-unnecessary-value-param
