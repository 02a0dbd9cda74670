// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "tests/verifier/interpreter.h"
#include "tests/verifier/reader.h"

namespace hcsp::verifier {

namespace {

class MinibexReader {
 public:
  explicit MinibexReader(const std::string& text) : reader_(text), interpreter_(system_) {}

  System read() {
    if (takes("constants")) {
      while (!sees("variables")) constant();
    }
    if (!takes("variables")) throw Unreadable(reader_.token().line, "expected variables");
    while (!sees("constraints")) variable();
    takes("constraints");
    while (!sees("end")) {
      interpreter_.constrain(indexed(reader_.expression()));
      reader_.take(";");
    }
    return std::move(system_);
  }

 private:
  /// Words in lower or upper case.
  [[nodiscard]] bool sees(const std::string& word) const {
    std::string here = reader_.token().text;
    std::transform(here.begin(), here.end(), here.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    if (reader_.at_end()) throw Unreadable(reader_.token().line, "expected " + word);
    return here == word;
  }
  bool takes(const std::string& word) { return sees(word) && reader_.take(reader_.token().text); }
  void separator() { static_cast<void>(reader_.take(";") || reader_.take(",")); }

  void constant() {
    const std::string name = reader_.name();
    if (!takes("in")) reader_.expect("=");
    interpreter_.name(name, interpreter_.value(reader_.expression()));
    separator();
  }

  void variable() {
    const std::string name = reader_.name();
    std::vector<std::pair<long, long>> ranges;
    while (reader_.take("[")) {
      for (const Tree& size : reader_.list("]")) ranges.emplace_back(1, interpreter_.whole(size));
    }
    if (!takes("in")) throw Unreadable(reader_.token().line, "expected a domain");
    interpreter_.declare(name, ranges, reader_.expression());
    if (!ranges.empty()) is_vector_.push_back(name);
    separator();
  }

  /// `x(i)` is an element of x.
  Tree indexed(Tree tree) const {
    for (Tree& part : tree.parts) part = indexed(std::move(part));
    if (tree.head != "call" || std::find(is_vector_.begin(), is_vector_.end(), tree.text) == is_vector_.end())
      return tree;
    Tree element{"index", "", tree.line, {{"name", tree.text, tree.line, {}}}};
    for (Tree& part : tree.parts) element.parts.push_back(std::move(part));
    return element;
  }

  System system_;
  Reader reader_;
  Interpreter interpreter_;
  std::vector<std::string> is_vector_;
};

}  // namespace

System read_minibex(const std::string& text) { return MinibexReader(text).read(); }

}  // namespace hcsp::verifier
