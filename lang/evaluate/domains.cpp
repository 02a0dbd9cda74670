// SPDX-License-Identifier: Apache-2.0
// Domains, and columns of data.
#include <algorithm>

#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

namespace {

const Number* constant(const std::optional<Term>& term) {
  return term ? std::get_if<Number>(&*term) : nullptr;
}

}  // namespace

DomainValue Evaluator::domain(const Expr& written) {
  const Expr& expr = model_.unfold(written);
  if (!take_step(expr)) return {};
  if (expr.kind == ExprKind::interval) {
    Bounds bounds;
    for (std::size_t i = 0; i < 2; ++i) {
      const Expr& bound = *expr.operands[i];
      const Expr& inner = bound.kind == ExprKind::unary ? *bound.operands[0] : bound;
      if (inner.kind == ExprKind::infinity) continue;
      const Value found = value(bound);
      if (found.empty()) return {};
      (i == 0 ? bounds.lo : bounds.hi) = found.front();
    }
    const Number* lo = constant(bounds.lo);
    const Number* hi = constant(bounds.hi);
    if (lo != nullptr && hi != nullptr && lo->enclosure.lo() > hi->enclosure.hi()) {
      model_.diagnostics().report(Code::empty_interval, expr.range);
      return {};
    }
    return {bounds};
  }
  if (expr.kind == ExprKind::tuple) {
    DomainValue all;
    for (const Expr* operand : expr.operands) {
      const bool is_domain = model_.type(*operand).is(Type::Kind::domain);
      if (is_domain) {
        const DomainValue component = domain(*operand);
        if (component.empty()) return {};
        all.insert(all.end(), component.begin(), component.end());
      } else {
        const Value component = value(*operand);
        if (component.empty()) return {};
        for (const Term& term : component) all.push_back({term, term});
      }
    }
    return all;
  }
  if (expr.kind == ExprKind::binary && expr.op == Operator::power) {
    const DomainValue base = domain(*expr.operands[0]);
    const auto count = whole(*expr.operands[1]);
    if (base.empty() || !count) return {};
    return DomainValue(static_cast<std::size_t>(*count), base.front());
  }
  if (expr.kind == ExprKind::binary && expr.op == Operator::plus_minus) {
    const Value centre = value(*expr.operands[0]);
    const Value error = value(*expr.operands[1]);
    if (centre.empty() || error.empty()) return {};
    DomainValue all;
    for (std::size_t i = 0; i < centre.size(); ++i) {
      const Term& e = error[error.size() == 1 ? 0 : i];
      const auto* known = std::get_if<Number>(&e);
      if (known != nullptr && known->enclosure.lo() < 0) {
        model_.diagnostics().report(Code::negative_error, expr.operands[1]->range);
        return {};
      }
      all.push_back({operate(Operator::subtract, centre[i], e), operate(Operator::add, centre[i], e)});
    }
    return all;
  }
  return {};
}

// ---- Columns.

std::optional<Column> Evaluator::member(const Expr& expr) {
  const Table& table = *model_.type(expr).data->table;
  const auto& names = table.columns();
  const auto index =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), expr.text) - names.begin());
  const std::pair key(&table, index);
  if (const auto known = converted_.find(key); known != converted_.end()) return known->second;
  return converted_.emplace(key, convert_column(table, index, model_.diagnostics())).first->second;
}

std::optional<std::vector<Column>> Evaluator::columns(const Expr& written) {
  const Expr& expr = model_.unfold(written);
  if (!take_step(expr)) return {};
  std::vector<Column> all;
  switch (expr.kind) {
    case ExprKind::member: {
      auto column = member(expr);
      if (!column) return {};
      all.push_back(std::move(*column));
      return all;
    }
    case ExprKind::tuple:
      for (const Expr* operand : expr.operands) {
        auto column = columns(*operand);
        if (!column) return {};
        all.push_back(std::move(column->front()));
      }
      return all;
    case ExprKind::unary: {
      auto negated = columns(*expr.operands[0]);
      if (!negated) return {};
      for (Column& column : *negated) {
        for (CellValue& cell : column.cells) cell.number = -cell.number;
      }
      return negated;
    }
    case ExprKind::binary:
      return column_arithmetic(expr);
    default:
      return {};
  }
}

std::optional<std::vector<Column>> Evaluator::column_arithmetic(const Expr& expr) {
  const auto is_column = [&](const Expr& operand) { return model_.type(operand).is(Type::Kind::column); };
  std::array<std::vector<Column>, 2> columns_of;
  std::array<Value, 2> numbers;
  for (std::size_t side = 0; side < 2; ++side) {
    const Expr& operand = *expr.operands[side];
    if (is_column(operand)) {
      auto found = columns(operand);
      if (!found) return {};
      columns_of[side] = std::move(*found);
    } else {
      numbers[side] = value(operand);
      if (numbers[side].empty()) return {};
    }
  }
  const auto size = [&](std::size_t side) { return std::max(columns_of[side].size(), numbers[side].size()); };
  std::vector<Column> result;
  for (std::size_t c = 0; c < std::max(size(0), size(1)); ++c) {
    const auto at = [&](std::size_t side, std::size_t row) -> CellValue {
      const std::size_t component = size(side) == 1 ? 0 : c;
      if (!columns_of[side].empty()) return columns_of[side][component].cells[row];
      return {CellValue::Kind::number, std::get<Number>(numbers[side][component])};
    };
    const auto& model = columns_of[columns_of[0].empty() ? 1 : 0];
    Column column = model[model.size() == 1 ? 0 : c];
    for (std::size_t row = 0; row < column.cells.size(); ++row) {
      column.cells[row] = combine(expr.op, at(0, row), at(1, row));
      if (column.cells[row].number.enclosure.is_empty()) {
        model_.diagnostics().report(Code::undefined_constant, column.table->range(row, column.index));
        return {};
      }
    }
    result.push_back(std::move(column));
  }
  return result;
}

CellValue Evaluator::combine(Operator op, const CellValue& a, const CellValue& b) {
  using Kind = CellValue::Kind;
  if (a.kind == Kind::blank || b.kind == Kind::blank) return {Kind::blank, {}};
  if (a.kind == Kind::no_echo || b.kind == Kind::no_echo) {
    // "At least this far" survives shifts and positive factors; of anything else it says nothing.
    const bool shifted = op == Operator::add || (op == Operator::subtract && b.kind == Kind::number);
    const CellValue& other = a.kind == Kind::number ? a : b;
    const bool scaled = (op == Operator::multiply || (op == Operator::divide && b.kind == Kind::number)) &&
                        other.kind == Kind::number && other.number.enclosure.lo() > 0;
    return {shifted || scaled ? Kind::no_echo : Kind::blank, {}};
  }
  return {Kind::number, std::get<Number>(operate(op, a.number, b.number))};
}

}  // namespace hcsp::lang
