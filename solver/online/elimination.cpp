// SPDX-License-Identifier: Apache-2.0
#include "solver/online/elimination.h"

#include <algorithm>
#include <optional>

#include "solver/expression/operators.h"
#include "solver/online/play.h"

namespace hcsp::online {

namespace {

// Whether a result is defined wherever all operands are, and nowhere else.
bool is_total_operator(Op op) {
  return with_operator(op, [](auto known) { return operators::is_total<typename decltype(known)::type>; });
}

class Eliminator {
 public:
  Eliminator(Dag& dag, Facts& facts, Facts& first, const Case& one, const Unknowns& unknowns, Purpose purpose)
      : dag_(dag),
        facts_(facts),
        first_(first),
        unknowns_(unknowns),
        purpose_(purpose),
        wanted_(one.wanted),
        definitions_(one.definitions) {
    if (purpose == Purpose::search) wanted_.resize(one.objectives);
    for (const Statement& statement : one.statements) {
      if (purpose == Purpose::search || !statement.is_implied) statements_.push_back(statement);
    }
    find_data();
  }

  View run(const std::map<Input, std::uint32_t>& name_of) {
    while (const auto next = best_equation()) define(*next);
    if (purpose_ == Purpose::search) fix_data();
    replace_equal_sides();
    View view;
    view.definitions = definitions_;
    view.nonzero = nonzero_;
    view.wanted = wanted_;
    for (const Statement& statement : statements_) {
      std::optional<Requirement> requirement = requirement_of(statement);
      if (!requirement) continue;
      requirement->is_implied = statement.is_implied;
      add(view, requirement);
    }
    for (const Definition& definition : definitions_) add_domain(view, definition, name_of);
    if (purpose_ == Purpose::proof) {
      for (const NodeId node : dropped_) add(view, Requirement{node, Interval::entire(), false, 0});
    }
    for_each_bound([&](const Input& input, NodeId value, bool is_upper) {
      view.bounds.push_back({input, value, is_upper});
    });
    for (const auto& [input, domain] : unknowns_.domains) {
      if (unknowns_.is_unknown(input) && !is_defined(input) && is_used(view, input))
        view.core.push_back(input);
    }
    return view;
  }

 private:
  struct Candidate {
    std::size_t statement;
    Input variable;
    std::size_t side;  // of the equation, where the variable is
  };

  // Whether an expression is 0 wherever it is defined, by its form.
  [[nodiscard]] bool is_zero(NodeId node) const {
    const DagNode& of = dag_[node];
    const auto [a, b, unused] = of.operands;
    switch (of.op) {
      case Op::mul:
        return is_zero(a) || is_zero(b);
      case Op::neg:
      case Op::div:
        return is_zero(a);
      case Op::add:
      case Op::sub:
        return is_zero(a) && is_zero(b);
      default:
        return is_number(dag_, node, 0.0);
    }
  }

  // What a sum is, wherever it is defined.
  [[nodiscard]] NodeId without_zeros(NodeId node) const {
    const DagNode& of = dag_[node];
    const auto [a, b, unused] = of.operands;
    if (of.op == Op::add && is_zero(a)) return without_zeros(b);
    return (of.op == Op::add || of.op == Op::sub) && is_zero(b) ? without_zeros(a) : node;
  }

  // f(unknown, what parameters bound it by, whether from above).
  template <class F>
  void for_each_bound(F f) const {
    for (const Statement& statement : statements_) {
      const DagNode& node = dag_[statement.relation];
      if (node.op != Op::less_equal && node.op != Op::less) continue;
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const DagNode& own = dag_[without_zeros(node.operands[side])];
        const NodeId other = node.operands[1 - side];
        if (own.op == Op::input && unknowns_.is_unknown(own.input) && facts_.is_given(other))
          f(own.input, other, side == 0);
      }
    }
  }

  // Unknowns that parameters bound from both sides are data with a little play: nothing is solved for them.
  void find_data() {
    std::set<Input> below, above;
    for_each_bound(
        [&](const Input& input, NodeId, bool is_upper) { (is_upper ? above : below).insert(input); });
    std::set_intersection(below.begin(), below.end(), above.begin(), above.end(),
                          std::inserter(data_, data_.begin()));
  }

  // In a search data with next to no play are given: low + [0, 1] (high - low), the same number wherever they
  // stand. Where later parameters leave them more play bounds are as wide, and as right.
  void fix_data() {
    std::map<Input, NodeId> low, high;
    std::vector<Definition> places;
    Rewriter rewrite(dag_, dag_);
    for_each_bound([&](const Input& input, NodeId value, bool is_upper) {
      (is_upper ? high : low).emplace(input, value);
    });
    for (const Input& input : data_) {
      const Interval play = join(first_.range(low.at(input)), first_.range(high.at(input)));
      if (play.is_empty() || !is_thin(play)) continue;
      const NodeId place = dag_.constant(Interval(0.0, 1.0), kPlaces + input.variable);
      const NodeId width = fold(dag_, Op::sub, {high.at(input), low.at(input), 0});
      const NodeId value = fold(dag_, Op::add, {low.at(input), fold(dag_, Op::mul, {place, width, 0}), 0});
      std::erase_if(statements_, [&](const Statement& statement) { return is_bound_of(statement, input); });
      rewrite.replace(dag_.input(input), value);
      places.push_back({input, value});
    }
    rewrite_all(rewrite, statements_.size());
    definitions_.insert(definitions_.end(), places.begin(), places.end());
  }

  [[nodiscard]] bool is_bound_of(const Statement& statement, const Input& input) const {
    const DagNode& node = dag_[statement.relation];
    if (node.op != Op::less_equal) return false;
    const auto is_pair = [&](std::size_t side) {
      const DagNode& own = dag_[node.operands[side]];
      return own.op == Op::input && own.input == input && facts_.is_given(node.operands[1 - side]);
    };
    return is_pair(0) || is_pair(1);
  }

  [[nodiscard]] bool is_defined(const Input& input) const {
    return std::any_of(definitions_.begin(), definitions_.end(),
                       [&](const Definition& definition) { return definition.variable == input; });
  }

  bool is_used(const View& view, const Input& input) const {
    const auto uses = [&](NodeId node) { return facts_.needs(node, input); };
    return std::any_of(view.requirements.begin(), view.requirements.end(),
                       [&](const Requirement& own) { return uses(own.root); }) ||
           std::any_of(view.definitions.begin(), view.definitions.end(),
                       [&](const Definition& own) { return uses(own.value); }) ||
           std::any_of(wanted_.begin(), wanted_.end(), uses);
  }

  /// Whether a factor is never 0; where parameters decide, they will.
  bool is_nonzero(NodeId factor) const {
    return !facts_.range(factor).contains(0.0) || facts_.is_given(factor);
  }

  // Of two operands the one that alone needs an unknown.
  std::optional<std::size_t> own_operand(const DagNode& of, const Input& input) const {
    const bool is_in_first = facts_.needs(of.operands[0], input),
               is_in_second = facts_.needs(of.operands[1], input);
    if (is_in_first == is_in_second) return {};
    return is_in_first ? 0 : 1;
  }

  // Down from a side to the unknown: the way is open where the unknown is written once, and each step can be
  // undone.
  bool is_isolable(NodeId node, const Input& input) const {
    const DagNode& of = dag_[node];
    if (of.op == Op::input) return true;
    if (of.op == Op::neg) return is_isolable(of.operands[0], input);
    const bool is_product = of.op == Op::mul || of.op == Op::div;
    if (!is_product && of.op != Op::add && of.op != Op::sub) return false;
    const auto own = own_operand(of, input);
    if (!own || (of.op == Op::div && *own == 1)) return false;
    return (!is_product || is_nonzero(of.operands[1 - *own])) && is_isolable(of.operands[*own], input);
  }

  void note_nonzero(NodeId factor) {
    if (facts_.range(factor).contains(0.0)) nonzero_.push_back(factor);
  }

  // What the unknown is, where node == rest.
  NodeId isolate(NodeId node, const Input& input, NodeId rest) {
    const DagNode of = dag_[node];
    const std::size_t k = of.op == Op::input || facts_.needs(of.operands[0], input) ? 0 : 1;
    const NodeId own = of.operands[k], other = of.operands[1 - k];
    switch (of.op) {
      case Op::neg:
        return isolate(own, input, fold(dag_, Op::neg, {rest, 0, 0}));
      case Op::add:
        return isolate(own, input, fold(dag_, Op::sub, {rest, other, 0}));
      case Op::sub:
        return isolate(
            own, input,
            k == 0 ? fold(dag_, Op::add, {rest, other, 0}) : fold(dag_, Op::sub, {other, rest, 0}));
      case Op::mul:
        note_nonzero(other);
        return isolate(own, input, fold(dag_, Op::div, {rest, other, 0}));
      case Op::div:
        note_nonzero(other);
        return isolate(own, input, fold(dag_, Op::mul, {rest, other, 0}));
      default:
        return rest;
    }
  }

  [[nodiscard]] bool is_real_equation(NodeId relation) const {
    const DagNode& node = dag_[relation];
    return node.op == Op::equal && !is_boolean(dag_[node.operands[0]].op) &&
           !is_boolean(dag_[node.operands[1]].op);
  }

  // What an equation could define; those that stand alone, if there are any.
  [[nodiscard]] std::vector<Candidate> candidates(std::size_t i) const {
    std::vector<Candidate> alone, isolable;
    const DagNode equation = dag_[statements_[i].relation];
    for (const Input& input : facts_.inputs_of(statements_[i].relation)) {
      if (!unknowns_.is_unknown(input) || data_.contains(input)) continue;
      const auto side = own_operand(equation, input);
      if (!side || !is_isolable(equation.operands[*side], input)) continue;
      const bool is_alone = dag_[equation.operands[*side]].op == Op::input;
      (is_alone ? alone : isolable).push_back({i, input, *side});
    }
    return alone.empty() ? isolable : alone;
  }

  // Implied definitions first, since they are written to define; then what leaves least to choose.
  [[nodiscard]] std::optional<Candidate> best_equation() const {
    std::optional<Candidate> best;
    std::pair<bool, std::size_t> best_rank;
    for (std::size_t i = 0; i < statements_.size(); ++i) {
      if (!is_real_equation(statements_[i].relation)) continue;
      const std::vector<Candidate> found = candidates(i);
      const std::pair rank{!statements_[i].is_implied, found.size()};
      if (found.empty() || (best && best_rank <= rank)) continue;
      best = found.front();
      best_rank = rank;
    }
    return best;
  }

  void rewrite_all(Rewriter& rewrite, std::size_t except) {
    for (std::size_t i = 0; i < statements_.size(); ++i) {
      if (i != except) statements_[i].relation = rewrite(statements_[i].relation);
    }
    for (Definition& definition : definitions_) definition.value = rewrite(definition.value);
    for (NodeId& node : wanted_) node = rewrite(node);
    for (NodeId& node : nonzero_) node = rewrite(node);
    // What is dropped now is in terms of what is left already.
    for (std::size_t i = 0; i < dropped_before_; ++i) {
      const NodeId rewritten = rewrite(dropped_[i]);
      dropped_[i] = rewritten;
    }
    dropped_before_ = dropped_.size();
  }

  // Nodes become others, which all need `input`. What becomes superfluous by a factor 0 is dropped: a proof
  // has to show that it is defined, a search is left with one requirement less. That is no less where it
  // turns a truth round.
  void rewrite_all(std::size_t except, const std::optional<Input>& input,
                   std::initializer_list<std::pair<NodeId, NodeId>> replaced) {
    Rewriter rewrite(dag_, dag_, &dropped_), careful(dag_, dag_);
    for (Rewriter* one : {&rewrite, &careful}) {
      for (const auto& [node, other] : replaced) one->replace(node, other);
      if (input) one->restrict_to(facts_, *input);
    }
    if (purpose_ == Purpose::search) rewrite.leave_truths_to(careful);
    rewrite_all(rewrite, except);
  }

  void define(const Candidate& by) {
    const DagNode equation = dag_[statements_[by.statement].relation];
    const NodeId side = equation.operands[by.side], other = equation.operands[1 - by.side];
    const NodeId value = isolate(side, by.variable, other);
    rewrite_all(by.statement, by.variable, {{dag_.input(by.variable), value}, {side, other}});
    definitions_.push_back({by.variable, value});
    statements_.erase(statements_.begin() + static_cast<std::ptrdiff_t>(by.statement));
  }

  // What an equation equates is the simpler of the two, everywhere else.
  void replace_equal_sides() {
    for (std::size_t i = 0; i < statements_.size(); ++i) {
      if (!is_real_equation(statements_[i].relation)) continue;
      auto [a, b, unused] = dag_[statements_[i].relation].operands;
      if (facts_.size(a).nodes < facts_.size(b).nodes) std::swap(a, b);
      if (facts_.size(a).nodes == 1 || facts_.is_part(a, b)) continue;
      const std::vector<Input> inputs = facts_.inputs_of(a);
      rewrite_all(i, inputs.empty() ? std::nullopt : std::optional(inputs.front()), {{a, b}});
    }
  }

  [[nodiscard]] std::optional<Requirement> requirement_of(const Statement& statement) {
    const DagNode node = dag_[statement.relation];
    const bool is_order = node.op == Op::less || node.op == Op::less_equal;
    if (is_number(dag_, statement.relation, 1.0)) return {};
    if (!is_order && !is_real_equation(statement.relation))
      return Requirement{statement.relation, kTrue, false, statement.name};
    const NodeId a = node.operands[0], b = node.operands[1];
    return order(a, b, is_order ? Interval::raw(-kInfinity, 0.0) : kFalse, node.op == Op::less,
                 statement.name);
  }

  [[nodiscard]] std::optional<Requirement> order(NodeId a, NodeId b, const Interval& wanted, bool strict,
                                                 std::uint32_t name) {
    const bool holds = !wanted.is_point() && !strict && is_at_most(dag_, a, b, facts_);
    const NodeId root = fold(dag_, Op::sub, {a, b, 0});
    if (!holds) return Requirement{root, wanted, strict, name};
    if (purpose_ == Purpose::search || dag_[root].is_total) return {};
    return Requirement{root, Interval::entire(), false, name};
  }

  // An expression is defined where those parts of it are that may not be. Of a choice only the branch that is
  // taken has to be: it stays whole.
  void add_partial_parts(View& view, const Requirement& whole, NodeId node) {
    if (dag_[node].is_total || !defined_.insert(node).second) return;
    const DagNode of = dag_[node];
    const int arity = operator_entry(of.op).arity;
    if (arity == 0 || is_boolean(of.op) || !is_total_operator(of.op)) {
      Requirement part = whole;
      part.root = node;
      return add_whole(view, part);
    }
    for (int k = 0; k < arity; ++k) add_partial_parts(view, whole, of.operands[static_cast<std::size_t>(k)]);
  }

  void add(View& view, const std::optional<Requirement>& requirement) {
    if (!requirement) return;
    if (requirement->wanted.is_entire()) return add_partial_parts(view, *requirement, requirement->root);
    add_whole(view, *requirement);
  }

  void add_whole(View& view, const Requirement& requirement) {
    (facts_.is_given(requirement.root) ? view.conditions : view.requirements).push_back(requirement);
  }

  // A defined unknown has its declared domain, and is defined.
  void add_domain(View& view, const Definition& definition, const std::map<Input, std::uint32_t>& name_of) {
    const Interval domain = purpose_ == Purpose::proof ? unknowns_.certain_domain(definition.variable)
                                                       : unknowns_.domains.at(definition.variable);
    const std::uint32_t name = name_of.at(definition.variable);
    const auto bound = [&](double x) { return dag_.constant(Interval::raw(x, x)); };
    const Interval at_most = Interval::raw(-kInfinity, 0.0);
    if (domain.lo() > -kInfinity)
      add(view, order(bound(domain.lo()), definition.value, at_most, false, name));
    if (domain.hi() < kInfinity) add(view, order(definition.value, bound(domain.hi()), at_most, false, name));
    if (domain.is_entire() && !dag_[definition.value].is_total)
      add(view, Requirement{definition.value, Interval::entire(), false, name});
  }

  Dag& dag_;
  static constexpr std::uint64_t kPlaces = std::uint64_t{1} << 40;  // origins of constants of no model

  Facts &facts_, &first_;
  const Unknowns& unknowns_;
  Purpose purpose_;
  std::vector<Statement> statements_;
  std::vector<NodeId> wanted_;
  std::vector<Definition> definitions_;
  std::vector<NodeId> nonzero_;
  std::set<Input> data_;
  std::set<NodeId> defined_;     // what is asked for to be defined, and its parts
  std::vector<NodeId> dropped_;  // what has to be defined, though nothing is made of its value
  std::size_t dropped_before_ = 0;
};

}  // namespace

View eliminate(Dag& dag, Facts& facts, Facts& first, const Case& one, const Unknowns& unknowns,
               Purpose purpose, const std::map<Input, std::uint32_t>& name_of) {
  return Eliminator(dag, facts, first, one, unknowns, purpose).run(name_of);
}

}  // namespace hcsp::online
