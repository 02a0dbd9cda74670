// SPDX-License-Identifier: Apache-2.0
// The table of operators and their derivative rules.
#include "solver/expression/operators.h"

#include "domains/check.h"

namespace hcsp {

namespace {

// Builds derivatives as nodes.
struct Builder {
  Dag& dag;
  NodeId y;
  [[nodiscard]] NodeId operand(int k) const { return dag[y].operands[static_cast<std::size_t>(k)]; }
  [[nodiscard]] NodeId number(double x) const { return dag.constant(Interval(x)); }
  [[nodiscard]] NodeId of(Op op, NodeId a) const { return dag.apply(op, {a}, 1); }
  [[nodiscard]] NodeId of(Op op, NodeId a, NodeId b) const { return dag.apply(op, {a, b}, 2); }
  [[nodiscard]] NodeId choose(NodeId condition, NodeId a, NodeId b) const {
    return dag.apply(Op::if_then_else, {condition, a, b}, 3);
  }
};

NodeId no_partial(Dag& dag, NodeId y, int) {
  require(false, "Dag: {} has no derivative", operator_entry(dag[y].op).name);
  return y;
}

// At a kink (abs at 0, min and max at ties) the hull of both one-sided derivatives.
NodeId one_sided(const Builder& b, NodeId lesser, NodeId greater, double when_less, double when_greater) {
  const NodeId kink = b.dag.constant(join(Interval(when_less), Interval(when_greater)));
  return b.choose(b.of(Op::less, lesser, greater), b.number(when_less),
                  b.choose(b.of(Op::less, greater, lesser), b.number(when_greater), kink));
}

NodeId partial(Op op, const Builder& b, int k) {
  switch (op) {
    case Op::neg:
      return b.number(-1.0);
    case Op::add:
      return b.number(1.0);
    case Op::sub:
      return b.number(k == 0 ? 1.0 : -1.0);
    case Op::mul:
      return b.operand(1 - k);
    case Op::div:
      if (k == 0) return b.of(Op::div, b.number(1.0), b.operand(1));
      return b.of(Op::neg, b.of(Op::div, b.y, b.operand(1)));
    case Op::sqr:
      return b.of(Op::mul, b.number(2.0), b.operand(0));
    case Op::sqrt:
      return b.of(Op::div, b.number(0.5), b.y);
    case Op::abs:
      return one_sided(b, b.operand(0), b.number(0.0), -1.0, 1.0);
    case Op::min:
      return one_sided(b, b.operand(k), b.operand(1 - k), 1.0, 0.0);
    case Op::max:
      return one_sided(b, b.operand(k), b.operand(1 - k), 0.0, 1.0);
    case Op::sin:
      return b.of(Op::cos, b.operand(0));
    case Op::cos:
      return b.of(Op::neg, b.of(Op::sin, b.operand(0)));
    case Op::atan2: {
      const NodeId squares = b.of(Op::add, b.of(Op::sqr, b.operand(0)), b.of(Op::sqr, b.operand(1)));
      const NodeId quotient = b.of(Op::div, b.operand(1 - k), squares);
      return k == 0 ? quotient : b.of(Op::neg, quotient);
    }
    case Op::exp:
      return b.y;
    case Op::log:
      return b.of(Op::div, b.number(1.0), b.operand(0));
    case Op::tan:
      return b.of(Op::add, b.number(1.0), b.of(Op::sqr, b.y));
    case Op::asin:
    case Op::acos: {
      const NodeId rest = b.of(Op::sub, b.number(1.0), b.of(Op::sqr, b.operand(0)));
      return b.of(Op::div, b.number(op == Op::asin ? 1.0 : -1.0), b.of(Op::sqrt, rest));
    }
    case Op::atan:
      return b.of(Op::div, b.number(1.0), b.of(Op::add, b.number(1.0), b.of(Op::sqr, b.operand(0))));
    case Op::sinh:
      return b.of(Op::cosh, b.operand(0));
    case Op::cosh:
      return b.of(Op::sinh, b.operand(0));
    case Op::tanh:
      return b.of(Op::sub, b.number(1.0), b.of(Op::sqr, b.y));
    case Op::pown:
      if (k == 1) return no_partial(b.dag, b.y, k);
      return b.of(Op::mul, b.operand(1),
                  b.of(Op::pown, b.operand(0), b.number(b.dag[b.operand(1)].value.lo() - 1.0)));
    case Op::pow:
      if (k == 1) return b.of(Op::mul, b.y, b.of(Op::log, b.operand(0)));
      return b.of(Op::mul, b.operand(1),
                  b.of(Op::pow, b.operand(0), b.of(Op::sub, b.operand(1), b.number(1.0))));
    case Op::root:
      if (k == 1) return no_partial(b.dag, b.y, k);
      return b.of(Op::div, b.y, b.of(Op::mul, b.operand(1), b.operand(0)));
    case Op::if_then_else:
      if (k == 1) return b.choose(b.operand(0), b.number(1.0), b.number(0.0));
      if (k == 2) return b.choose(b.operand(0), b.number(0.0), b.number(1.0));
      return no_partial(b.dag, b.y, k);
    default:
      return no_partial(b.dag, b.y, k);
  }
}

NodeId partial_entry(Dag& dag, NodeId y, int k) { return partial(dag[y].op, Builder{dag, y}, k); }

}  // namespace

const OperatorEntry& operator_entry(Op op) {
  static const OperatorEntry kLeaf{"leaf", 0, no_partial};
  switch (op) {
#define HCSP_ENTRY(name, type, text, arity)                        \
  case Op::name: {                                                 \
    static const OperatorEntry kEntry{text, arity, partial_entry}; \
    return kEntry;                                                 \
  }
    HCSP_OPERATORS(HCSP_ENTRY)
#undef HCSP_ENTRY
    default:
      return kLeaf;
  }
}

}  // namespace hcsp
