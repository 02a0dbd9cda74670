// SPDX-License-Identifier: Apache-2.0
// A model under check: its syntax tree, what its names stand for, and the type of every expression.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "lang/data/column.h"
#include "lang/data/table.h"
#include "lang/diagnostics.h"
#include "lang/model/built_in.h"
#include "lang/model/type.h"
#include "lang/syntax/ast.h"
#include "solver/expression/expr.h"

namespace hcsp::lang {

/// A name of the top level.
struct Symbol {
  std::variant<const ParamItem*, const DataItem*, const TimeItem*, const FunctionItem*, const GivenItem*,
               const VarItem*, const LetItem*, const ConstraintItem*>
      item;
  Name name;
  enum class State : std::uint8_t { unvisited, visiting, done };
  State state = State::unvisited;
  Type type;                      ///< of the value; of a function, its result
  bool unknown = false;           ///< a parameter whose value is a domain: an unknown of that domain
  bool open = false;              ///< a parameter whose value is given when the compiled problem is solved
  bool takes_instants = false;    ///< tubes at instants to be found occur in its definition
  bool states = false;            ///< of a function: its body is stated as a constraint
  std::vector<Type> parameters;   ///< of a function
  std::uint32_t first_local = 0;  ///< of a function: its parameters' locals, then those of its where
  const Table* table = nullptr;   ///< of data; null when reading it failed

  template <class ItemType>
  [[nodiscard]] const ItemType* as() const {
    const auto* held = std::get_if<const ItemType*>(&item);
    return held == nullptr ? nullptr : *held;
  }
};

/// What a name in an expression stands for.
struct Reference {
  static constexpr std::uint32_t kNoLocal = 0xFFFFFFFF;
  const Symbol* symbol = nullptr;
  std::uint32_t local = kNoLocal;  ///< a parameter of a function, a local of its where, a bound point
  BuiltIn built_in = BuiltIn::none;
};

/// Whether an index is one of those of a type with components, or a row of a column; reports otherwise.
bool require_index(const Type& type, int index, const SourceRange& range, Diagnostics& diagnostics);
/// Whether a bound name runs over whole numbers: `i in 1..n`.
bool is_whole_range(const Binding& binding);
/// Whether all the names that an expression binds run over whole numbers.
bool ranges_over_numbers(const Expr& expr);

class Model;
/// A line a name, in the order of declaration, with its type; of a function, those of its parameters too.
std::string dump_types(const Model& model);

class Model {
 public:
  Model(SyntaxTree& tree, Diagnostics& diagnostics) : tree_(&tree), diagnostics_(&diagnostics) {}

  [[nodiscard]] SyntaxTree& tree() const { return *tree_; }
  [[nodiscard]] Diagnostics& diagnostics() const { return *diagnostics_; }

  std::string name;
  std::deque<Symbol> symbols;  ///< in the order of declaration
  std::unordered_map<std::string_view, Symbol*> by_name;
  std::vector<const Symbol*> definitions;  ///< parameters and lets, each after those that it uses
  const Symbol* time = nullptr;
  /// Whether the instants of the time line are unknown: `time t in [0, T] phases tau`.
  [[nodiscard]] bool has_phases() const { return time != nullptr && time->as<TimeItem>()->phases != nullptr; }
  const SolveItem* goal = nullptr;
  std::set<std::string_view> open_parameters;  ///< those that stay open where their types allow it
  double precision = 0.0;               ///< of the goal; 0 where it states none. The compiler finds it.
  std::optional<hcsp::Expr> objective;  ///< of the goal; the compiler finds it too
  std::vector<hcsp::Expr> paved;        ///< of `solve pave`: the coordinates. The compiler finds them.
  /// The constant instants at which tubes are taken: x(0).
  std::vector<const Expr*> instants;
  std::deque<Table> tables;

  /// An error for an expression that has not been checked.
  [[nodiscard]] Type type(const Expr& expr) const {
    return expr.id < types_.size() ? types_[expr.id] : Type{};
  }
  void set_type(const Expr& expr, const Type& type) { grow(types_, expr) = type; }
  [[nodiscard]] Reference reference(const Expr& expr) const {
    return expr.id < references_.size() ? references_[expr.id] : Reference{};
  }
  void set_reference(const Expr& expr, const Reference& reference) { grow(references_, expr) = reference; }

  /// Whether a relation is one to state as a constraint, no expression of reals: it speaks of sets, of a
  /// derivative, or of relations that each hold at every instant or at some.
  [[nodiscard]] bool is_stated(const Expr& expr) const {
    return expr.id < stated_.size() && stated_[expr.id];
  }
  void set_stated(const Expr& expr) {
    if (expr.id >= stated_.size()) stated_.resize(tree_->expressions());
    stated_[expr.id] = true;
  }

  /// The expression that a name of a `let` stands for, followed to the end; any other expression is itself.
  [[nodiscard]] const Expr& unfold(const Expr& expr) const;

 private:
  template <class Entry>
  Entry& grow(std::vector<Entry>& entries, const Expr& expr) {
    if (expr.id >= entries.size()) entries.resize(tree_->expressions());
    return entries[expr.id];
  }

  SyntaxTree* tree_;
  Diagnostics* diagnostics_;
  std::vector<Type> types_;
  std::vector<Reference> references_;
  std::vector<bool> stated_;
};

}  // namespace hcsp::lang
