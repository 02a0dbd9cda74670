// SPDX-License-Identifier: Apache-2.0
#include "lang/loader.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "lang/data/file.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

constexpr std::size_t kDeepestInclude = 64;

class Loader {
 public:
  Loader(SyntaxTree& tree, const std::vector<std::string>& library, Diagnostics& diagnostics)
      : tree_(tree), library_(library), diagnostics_(diagnostics) {}

  void load(const Source& source) {
    open_.push_back(identity(source.name()));
    done_.insert(open_.back());
    const std::size_t first = tree_.items.size();
    parse_items(source, tree_, diagnostics_);
    // Items that follow an include wait until the included ones stand.
    std::vector<Item> own(std::make_move_iterator(tree_.items.begin() + static_cast<std::ptrdiff_t>(first)),
                          std::make_move_iterator(tree_.items.end()));
    tree_.items.resize(first);
    for (Item& item : own) {
      const auto* include = std::get_if<IncludeItem>(&item.content);
      if (include != nullptr) load_included(source, include->path);
      tree_.items.push_back(std::move(item));
    }
    open_.pop_back();
  }

 private:
  // One file has many names: a path without . and .., as far as it exists.
  static std::string identity(const std::string& path) {
    std::error_code error;
    const auto canonical = std::filesystem::weakly_canonical(path, error);
    return error ? path : canonical.string();
  }

  // Beside the file that includes it or in the library; if nowhere, beside the file, for the message.
  [[nodiscard]] std::string find(const std::string& from, const std::string& written) const {
    std::string own = beside(from, written);
    std::error_code ignored;
    if (std::filesystem::exists(own, ignored)) return own;
    for (const std::string& folder : library_) {
      std::string shared = (std::filesystem::path(folder) / written).string();
      if (std::filesystem::exists(shared, ignored)) return shared;
    }
    return own;
  }

  void load_included(const Source& from, const Name& written) {
    const std::string path = find(from.name(), std::string(written.text));
    const std::string file = identity(path);
    if (std::find(open_.begin(), open_.end(), file) != open_.end() || open_.size() >= kDeepestInclude) {
      diagnostics_.report(Code::include_cycle, written.range, written.text);
      return;
    }
    if (done_.contains(file)) return;
    std::string error;
    auto text = read_file(path, error);
    if (!text) {
      diagnostics_.report(Code::unreadable_file, written.range, path, error);
      return;
    }
    load(tree_.add_source(path, std::move(*text)));
  }

  SyntaxTree& tree_;
  const std::vector<std::string>& library_;
  Diagnostics& diagnostics_;
  std::vector<std::string> open_;
  std::set<std::string> done_;
};

}  // namespace

void load(const Source& source, SyntaxTree& tree, const std::vector<std::string>& library,
          Diagnostics& diagnostics) {
  Loader(tree, library, diagnostics).load(source);
}

}  // namespace hcsp::lang
