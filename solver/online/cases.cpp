// SPDX-License-Identifier: Apache-2.0
#include "solver/online/cases.h"

#include <algorithm>
#include <optional>

#include "domains/check.h"
#include "solver/expression/connectives.h"
#include "solver/expression/operators.h"

namespace hcsp::online {

namespace {

class Splitter {
 public:
  Splitter(Dag& dag, Facts& facts, const Unknowns& unknowns, std::size_t most)
      : dag_(dag), facts_(facts), unknowns_(unknowns), most_(most) {}

  void split(const Case& one) {
    Case flat = one;
    flat.statements.clear();
    for (const Statement& statement : one.statements) {
      if (add_conjuncts(statement, flat.statements)) continue;
      refuted_by_ = statement.name;
      return;
    }
    if (const auto next = next_choice(flat, true)) return split_by_alternatives(flat, *next);
    if (substitute_givens(flat)) return split(flat);
    if (const auto whole = next_whole(flat)) return split_by_values(flat, *whole);
    if (const auto next = next_choice(flat, false)) return split_by_alternatives(flat, *next);
    require(cases_.size() < most_, "compile: the problem has more than {} cases", most_);
    cases_.push_back(std::move(flat));
  }

  std::vector<Case> take(const Case& whole) {
    if (cases_.empty()) {
      Case& none = cases_.emplace_back(whole);
      none.statements = {{dag_.constant(kFalse), refuted_by_, false}};
    }
    return std::move(cases_);
  }

 private:
  // False where the statement holds nowhere.
  bool add_conjuncts(const Statement& statement, std::vector<Statement>& to) {
    for (const NodeId part : hcsp::operands_of(dag_, without_negation(statement.relation), Op::logical_and)) {
      if (facts_.range(part).hi() == 0.0) return false;
      if (is_number(dag_, part, 1.0)) continue;
      to.push_back({part, statement.name, statement.is_implied});
    }
    return true;
  }

  // not (a and b) as not a or not b, and so on.
  NodeId without_negation(NodeId node) {
    if (dag_[node].op != Op::logical_not) return node;
    const DagNode inner = dag_[dag_[node].operands[0]];
    if (inner.op != Op::logical_and && inner.op != Op::logical_or) return node;
    const auto negated = [&](std::size_t k) {
      return without_negation(fold(dag_, Op::logical_not, {inner.operands[k], 0, 0}));
    };
    const NodeId a = negated(0), b = negated(1);
    return fold(dag_, inner.op == Op::logical_and ? Op::logical_or : Op::logical_and, {a, b, 0});
  }

  std::optional<Input> next_whole(const Case& one) {
    for (const Input& whole : unknowns_.whole) {
      const auto needs = [&](NodeId node) { return facts_.needs(node, whole); };
      const bool is_needed =
          std::any_of(one.wanted.begin(), one.wanted.end(), needs) ||
          std::any_of(one.statements.begin(), one.statements.end(),
                      [&](const Statement& statement) { return needs(statement.relation); });
      if (is_needed) return whole;
    }
    return {};
  }

  void split_by_values(const Case& one, const Input& whole) {
    const Interval domain = unknowns_.domains.at(whole);
    constexpr double kGreatest = 0x1p53;  // doubles further out are not all whole numbers
    require(domain.mag() <= kGreatest && domain.hi() - domain.lo() < static_cast<double>(most_),
            "compile: a whole number between {} and {} has too many values", domain.lo(), domain.hi());
    for (double value = domain.lo(); value <= domain.hi(); value += 1.0) {
      Rewriter rewrite(dag_, dag_);
      rewrite.replace(dag_.input(whole), dag_.constant(Interval(value)));
      rewrite.restrict_to(facts_, whole);
      Case chosen = one;
      chosen.chosen[whole] = value;
      for (Statement& statement : chosen.statements) statement.relation = rewrite(statement.relation);
      for (NodeId& node : chosen.wanted) node = rewrite(node);
      split(chosen);
    }
  }

  // Implied alternatives first: they are written to tell cases apart. Or those only that parameters decide,
  // one of them alone.
  std::optional<std::size_t> next_choice(const Case& one, bool is_by_givens) {
    std::optional<std::size_t> next;
    const auto is_choice = [&](NodeId relation) {
      const std::vector<NodeId> all = alternatives_of(relation);
      const auto is_given = [&](NodeId alternative) { return facts_.is_given(alternative); };
      return is_by_givens ? std::any_of(all.begin(), all.end(), is_given) : !all.empty();
    };
    for (std::size_t i = 0; i < one.statements.size(); ++i) {
      const bool is_better = !next || (one.statements[i].is_implied && !one.statements[*next].is_implied);
      if (is_better && is_choice(one.statements[i].relation)) next = i;
    }
    return next;
  }

  // Once for all cases that follow. False where there was nothing to do.
  bool substitute_givens(Case& one) {
    Rewriter rewrite(dag_, dag_);  // drops nothing, so that what is one node remains one
    const std::size_t before = one.definitions.size();
    std::erase_if(one.statements, [&](const Statement& statement) {
      const auto definition = statement.is_implied ? std::nullopt : given_by(statement.relation);
      if (!definition) return false;
      const bool is_new =
          std::none_of(one.definitions.begin(), one.definitions.end(),
                       [&](const auto& known) { return known.variable == definition->variable; });
      if (!is_new) return false;
      rewrite.replace(dag_.input(definition->variable), definition->value);
      one.definitions.push_back(*definition);
      return true;
    });
    if (one.definitions.size() == before) return false;
    for (Statement& statement : one.statements) statement.relation = rewrite(statement.relation);
    for (NodeId& node : one.wanted) node = rewrite(node);
    return true;
  }

  // Where a relation is: unknown == what parameters decide.
  std::optional<Definition> given_by(NodeId relation) {
    const DagNode& equation = dag_[relation];
    if (equation.op != Op::equal) return {};
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const DagNode& own = dag_[equation.operands[side]];
      const NodeId value = equation.operands[1 - side];
      const bool is_unknown = own.op == Op::input && unknowns_.is_unknown(own.input);
      if (is_unknown && !unknowns_.whole.contains(own.input) && facts_.is_given(value) &&
          !is_boolean(dag_[value].op))
        return Definition{own.input, value};
    }
    return {};
  }

  // An alternative that is stated anyway is the one to take; those that contradict what is stated are none.
  void split_by_alternatives(const Case& one, std::size_t i) {
    std::vector<NodeId> alternatives = alternatives_of(one.statements[i].relation);
    const auto is_stated = [&](NodeId relation) {
      return std::any_of(one.statements.begin(), one.statements.end(),
                         [&](const Statement& other) { return other.relation == relation; });
    };
    const auto stated = std::find_if(alternatives.begin(), alternatives.end(), is_stated);
    if (stated != alternatives.end()) alternatives = {*stated};
    std::erase_if(alternatives, [&](NodeId relation) { return is_contradicted(one, relation); });
    if (alternatives.empty()) refuted_by_ = one.statements[i].name;
    for (const NodeId alternative : alternatives) {
      Case chosen = one;
      chosen.statements[i].relation = alternative;
      split(chosen);
    }
  }

  // a == b where a < b or b < a is stated, and the other way round.
  bool is_contradicted(const Case& one, NodeId relation) {
    const DagNode own = dag_[relation];
    return std::any_of(one.statements.begin(), one.statements.end(), [&](const Statement& other) {
      const DagNode& stated = dag_[other.relation];
      const bool is_pair = (own.op == Op::equal && stated.op == Op::less) ||
                           (own.op == Op::less && (stated.op == Op::equal || stated.op == Op::less));
      const auto [a, b, unused] = own.operands;
      const auto [c, d, unused_too] = stated.operands;
      return is_pair && ((a == d && b == c) || (a == c && b == d && own.op != stated.op));
    });
  }

  // Of a relation that is true where one of them is, if they are worth a case each: one states an equation.
  std::vector<NodeId> alternatives_of(NodeId relation) {
    std::vector<NodeId> all = hcsp::operands_of(dag_, relation, Op::logical_or);
    for (NodeId& one : all) one = without_negation(one);
    const bool has_equation =
        std::any_of(all.begin(), all.end(), [&](NodeId one) { return states_equation(one); });
    return all.size() > 1 && has_equation ? all : std::vector<NodeId>{};
  }

  bool states_equation(NodeId relation) {
    const std::vector<NodeId> parts = hcsp::operands_of(dag_, relation, Op::logical_and);
    if (parts.size() > 1)
      return std::any_of(parts.begin(), parts.end(), [&](NodeId part) { return states_equation(part); });
    const DagNode& node = dag_[relation];
    if (node.op == Op::logical_or) return !alternatives_of(relation).empty();
    return node.op == Op::equal && !facts_.is_given(relation);
  }

  Dag& dag_;
  Facts& facts_;
  const Unknowns& unknowns_;
  std::size_t most_;
  std::vector<Case> cases_;
  std::uint32_t refuted_by_ = 0;
};

}  // namespace

std::vector<Case> split_into_cases(Dag& dag, Facts& facts, const Case& whole, const Unknowns& unknowns,
                                   std::size_t most) {
  Splitter splitter(dag, facts, unknowns, most);
  splitter.split(whole);
  return splitter.take(whole);
}

}  // namespace hcsp::online
