// SPDX-License-Identifier: Apache-2.0
#include "solver/problem.h"

#include <cmath>

#include "domains/rounding.h"
#include "solver/contractors/delay.h"
#include "solver/contractors/integrality.h"
#include "solver/problem_impl.h"

namespace hcsp {

Problem::Problem(std::string name) : impl_(std::make_unique<Impl>()) { impl_->name = std::move(name); }
Problem::~Problem() = default;

RealVariable Problem::real(std::string name, const Interval& domain) {
  return {impl_->add(name, domain, DomainKind::real)};
}

IntegerVariable Problem::integer(std::string name, const Interval& domain) {
  const VariableId id = impl_->add(name, whole_numbers_of(domain), DomainKind::real);
  impl_->shapes[id].scalar = Shape::Scalar::whole;
  impl_->whole.insert(id);
  impl_->state(make_integrality_contractor(name + " is whole", id), true);
  return {id};
}

BooleanVariable Problem::boolean(std::string name) {
  const VariableId id = integer(std::move(name), Interval(0.0, 1.0)).id;
  impl_->shapes[id].scalar = Shape::Scalar::boolean;
  return {id};
}

BooleanVariable Problem::hidden_boolean(std::string name) {
  const VariableId id = impl_->add(impl_->free_name(name), Interval(0.0, 1.0), DomainKind::real, true);
  impl_->whole.insert(id);
  impl_->state(make_integrality_contractor(impl_->graph.variable(id).name(), id), true);
  return {id};
}

VectorVariable Problem::vector(std::string name, const Box& domain) {
  return impl_->add_vector(name, domain);
}

RealVariable Problem::parameter(std::string name, const Interval& value) {
  const RealVariable given = real(std::move(name), value);
  impl_->parameters.insert(given.id);
  return given;
}

VectorVariable Problem::parameter_vector(std::string name, const Box& value) {
  const VectorVariable given = vector(std::move(name), value);
  for (std::size_t i = 0; i < given.dim; ++i) impl_->parameters.insert(given.id + static_cast<VariableId>(i));
  return given;
}

RealVariable Problem::parameter(std::string name, Expr follows) {
  const NodeId node = impl_->node_of(follows);
  const RealVariable given = parameter(std::move(name), impl_->value_of_parameters(node));
  impl_->followed.emplace(given.id, node);
  return given;
}

VectorVariable Problem::parameter_vector(std::string name, const VectorExpr& follows) {
  Box value(static_cast<Eigen::Index>(follows.size()));
  for (std::size_t i = 0; i < follows.size(); ++i)
    value[static_cast<Eigen::Index>(i)] = impl_->value_of_parameters(impl_->node_of(follows[i]));
  const VectorVariable given = parameter_vector(std::move(name), value);
  for (std::size_t i = 0; i < given.dim; ++i)
    impl_->followed.emplace(given.id + static_cast<VariableId>(i), follows[i].node());
  return given;
}

// Empty where it is undefined.
Interval Problem::Impl::value_of_parameters(NodeId id) const {
  const RoundUpward guard;
  const Program program(dag, {id});
  Evaluation evaluation(program);
  for (std::uint32_t i = 0; i < program.inputs().size(); ++i) {
    const Input& input = program.inputs()[i];
    require(input.kind == Input::Kind::real && parameters.contains(input.variable),
            "Problem: a parameter that follows what is no parameter");
    evaluation.set(i, graph.initial<Interval>(input.variable));
  }
  evaluation.forward();
  return evaluation.defined(program.root()) ? evaluation.get(program.root()) : Interval::empty();
}

void Problem::set_time_line(TimeLine line) {
  require(impl_->phases == nullptr, "Problem: there is one time line, and it has phases");
  require(impl_->line == nullptr, "Problem: there is one time line, and it is set already");
  impl_->line = std::make_shared<const TimeLine>(std::move(line));
}

const std::shared_ptr<const TimeLine>& Problem::time_line() const { return impl_->line; }

TubeVariable Problem::tube(std::string name, std::size_t dim) {
  if (impl_->phases != nullptr) return impl_->add_phase_tube(name, dim);
  impl_->need_line();
  return tube(std::move(name), Tube(impl_->line, dim));
}

TubeVariable Problem::tube(std::string name, const Tube& domain) {
  impl_->need_line();
  require(domain.line() == *impl_->line, "Problem: the tube {} stands on another time line", name);
  return {impl_->add(name, domain, DomainKind::tube), domain.dim()};
}

void Problem::set_readings(TubeVariable tube, std::vector<Reading> readings) {
  impl_->need_line();
  for (const Reading& reading : readings) {
    require(reading.gate <= impl_->line->slices(), "Problem: there is no gate {}", reading.gate);
  }
  impl_->sampled->insert(tube.id);
  impl_->readings[tube.id] = std::move(readings);
}

SetVariable Problem::set(std::string name, std::size_t dim, double precision,
                         const std::optional<Box>& frame) {
  return {impl_->add(name, SetInterval(dim, precision, frame), DomainKind::set), dim};
}

VectorVariable Problem::matrix(std::string name, std::size_t rows, const Box& domain) {
  const auto components = static_cast<std::size_t>(domain.dim());
  require(rows > 0 && components > 0 && components % rows == 0, "Problem: {} components in {} rows",
          components, rows);
  const VectorVariable matrix = vector(std::move(name), domain);
  impl_->shapes[matrix.id].columns = components / rows;
  return matrix;
}

void Problem::set_certain_domain(VariableId id, const Interval& written) {
  const Interval certain = impl_->whole.contains(id) ? whole_numbers_of(written) : written;
  require(leq(certain, impl_->graph.initial<Interval>(id)),
          "Problem: the certain domain {} is not in the domain", to_string(certain));
  impl_->certain[id] = certain;
}

void Problem::place_in_array(VariableId element, std::string array, std::vector<int> indices) {
  impl_->shapes[element].array = std::move(array);
  impl_->shapes[element].indices = std::move(indices);
}

Expr Problem::component(VectorVariable x, std::size_t i) {
  require(i < x.dim, "Problem: component {} of {}", i + 1, x.dim);
  return impl_->component(x, i);
}

Expr Problem::constant(const Interval& value, std::uint64_t origin) {
  return {impl_->dag, impl_->dag.constant(value, origin)};
}
Expr Problem::unknown_constant(const Interval& value) { return {impl_->dag, impl_->dag.own_constant(value)}; }
Expr Problem::operator()(RealVariable x) { return impl_->input(Input::Kind::real, x.id, 0); }
Expr Problem::operator()(IntegerVariable x) { return impl_->input(Input::Kind::real, x.id, 0); }
// Between the two values, so that either truth of the relation leaves but one of them.
Expr Problem::operator()(BooleanVariable x) {
  return impl_->input(Input::Kind::real, x.id, 0) > Interval(0.5);
}
VectorExpr Problem::operator()(VectorVariable x) { return impl_->components(x); }
VectorExpr Problem::operator()(TubeVariable x) { return impl_->inputs(Input::Kind::tube, x.id, x.dim); }

VectorExpr Problem::at(TubeVariable x, double t) {
  if (impl_->phases != nullptr) return at(x, constant(Interval(t)));
  impl_->need_line();
  const auto gate = impl_->line->gate_at(t);
  require(gate.has_value(), "Problem: {} is not an instant of the time line", t);
  if (impl_->each_instant != nullptr) impl_->each_instant->anchored.insert(x.id);
  return impl_->inputs(Input::Kind::gate, x.id, x.dim, *gate);
}

VectorExpr Problem::at(TubeVariable x, Expr instant) {
  if (impl_->phases != nullptr) {
    const auto gate = impl_->phases->gate_of(instant);
    require(gate.has_value(), "Problem: an instant that is no gate, on a time line with phases");
    return impl_->inputs(Input::Kind::gate, x.id, x.dim, *gate);
  }
  impl_->need_line();
  impl_->require_all_time("an instant to be found");
  const NodeId node = impl_->node_of(instant);
  const Program program(impl_->dag, {node});
  for (const Input& input : program.inputs()) {
    require(input.kind != Input::Kind::tube && input.kind != Input::Kind::time,
            "Problem: an instant that varies with time");
  }
  const auto known = impl_->values.find({x.id, node});
  if (known != impl_->values.end()) return impl_->components(known->second);
  const DagNode& leaf = impl_->dag[node];
  const bool is_unknown = leaf.op == Op::input && leaf.input.kind == Input::Kind::real;
  const std::string name = impl_->free_name(
      fmt::format("{}({})", impl_->graph.variable(x.id).name(),
                  is_unknown ? impl_->graph.variable(leaf.input.variable).name() : "an instant"));
  const VectorVariable value = impl_->add_vector(name, Box(static_cast<Eigen::Index>(x.dim)), true);
  impl_->values.emplace(std::pair(x.id, node), value);
  const VectorExpr found = impl_->components(value);
  const Meanwhile all_time(impl_->window, std::shared_ptr<const ItemSet>());
  constrain_sometime(name, time() == instant && found == (*this)(x));
  return found;
}

VectorExpr Problem::delayed(TubeVariable x, double delay) {
  impl_->need_line();
  require(std::isfinite(delay), "Problem: a delay of {}", delay);
  const auto known = impl_->delayed.find({x.id, delay});
  if (known != impl_->delayed.end()) return impl_->inputs(Input::Kind::tube, known->second, x.dim);
  const std::string name = impl_->free_name(
      fmt::format("{}(t {} {})", impl_->graph.variable(x.id).name(), delay < 0 ? "+" : "-", std::abs(delay)));
  require(!impl_->is_own_to_an_instant(x.id), "Problem: {} is of one instant", name);
  VariableId value = 0;
  impl_->define([&] {
    value = impl_->add(name, Tube(impl_->line, x.dim), DomainKind::tube, true);
    impl_->state(make_delay_contractor(name, value, x.id, *impl_->line, delay));
  });
  impl_->delayed.emplace(std::pair(x.id, delay), value);
  return impl_->inputs(Input::Kind::tube, value, x.dim);
}

TubeVariable Problem::integral(const VectorExpr& f, double from) {
  impl_->need_line();
  impl_->require_all_time("an integral");
  const auto start = impl_->line->gate_at(from);
  require(start.has_value(), "Problem: {} is not an instant of the time line", from);
  std::vector<NodeId> nodes;
  for (const Expr& component : f) nodes.push_back(impl_->node_of(component));
  const auto known = impl_->integrals.find({nodes, from});
  if (known != impl_->integrals.end()) return {known->second, f.size()};
  const std::string name = impl_->free_name(fmt::format("integral from {}", from));
  Tube domain(impl_->line, f.size());
  for (std::size_t c = 0; c < f.size(); ++c) domain.set(c, 2 * *start, 0.0);
  const VariableId value = impl_->add(name, std::move(domain), DomainKind::tube, true);
  impl_->integrals.emplace(std::pair(nodes, from), value);
  const Meanwhile all_time(impl_->window, std::shared_ptr<const ItemSet>());
  constrain_derivative(name, {value, f.size()}, f);
  return {value, f.size()};
}

Expr Problem::instant(std::string name) {
  impl_->need_line();
  impl_->require_all_time("an instant to be found");
  Interval span(impl_->line->start(), impl_->line->end());
  if (impl_->window != nullptr) {
    span = Interval::empty();
    impl_->window->for_each([&](std::size_t item) { span = join(span, impl_->line->span(item)); });
  }
  return impl_->input(Input::Kind::real, impl_->add(impl_->free_name(name), span, DomainKind::real, true), 0);
}

Expr Problem::time() {
  if (impl_->phases == nullptr) impl_->need_line();
  return impl_->input(Input::Kind::time, 0, 0);
}

VectorExpr Problem::point(std::size_t dim) { return impl_->inputs(Input::Kind::point, 0, dim); }

void Problem::use_fast_paths(bool use) { impl_->fast_paths = use; }
const std::string& Problem::name() const { return impl_->name; }
const ContractorGraph& Problem::graph() const { return impl_->graph; }

Result Problem::propagate(const PropagationOptions& options) {
  define_phases();
  return run_problem(impl_->view(), options);
}

}  // namespace hcsp
