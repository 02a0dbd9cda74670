// SPDX-License-Identifier: Apache-2.0
#include "lang/compile/tube_plan.h"

#include <algorithm>
#include <map>

namespace hcsp::lang {

namespace {

class Planner {
 public:
  Planner(Model& model, Evaluator& evaluator) : model_(model), evaluator_(evaluator) {}

  std::optional<TubePlan> plan(const Expr& written) {
    const Expr& expr = model_.unfold(written);
    const Type& type = model_.type(expr);
    if (!type.tube) return constant(expr);
    if (expr.kind == ExprKind::tuple) {
      TubePlan all;
      for (const Expr* operand : expr.operands) {
        auto parts = plan(*operand);
        if (!parts) return {};
        std::move(parts->begin(), parts->end(), std::back_inserter(all));
      }
      return all;
    }
    if (expr.kind == ExprKind::binary && expr.op == Operator::plus_minus) return with_error(expr);
    if (expr.kind == ExprKind::call) {
      const BuiltIn function = model_.reference(*expr.operands[0]).built_in;
      if (function == BuiltIn::hold || function == BuiltIn::sampled) return rows(expr, function);
    }
    model_.diagnostics().report(Code::not_supported, expr.range, "a domain of this form");
    return {};
  }

 private:
  std::optional<TubePlan> constant(const Expr& expr) {
    const auto box = evaluator_.box(expr);
    if (!box) return {};
    TubePart part;
    for (Eigen::Index i = 0; i < box->dim(); ++i) part.domain.push_back((*box)[i]);
    return plan_of(std::move(part));
  }

  std::optional<TubePlan> rows(const Expr& expr, BuiltIn function) {
    TubePart part;
    part.kind = function == BuiltIn::hold ? TubePart::Kind::hold : TubePart::Kind::sampled;
    part.range = expr.range;
    const auto stamps = evaluator_.columns(*expr.operands[1]);
    if (!stamps) return {};
    auto instants = instants_of(stamps->front(), model_.diagnostics());
    if (!instants) return {};
    part.stamps = std::move(*instants);
    auto columns = evaluator_.columns(*expr.operands[2]);
    if (!columns || !check_cells(*columns, part.kind)) return {};
    part.columns = std::move(*columns);
    if (expr.operands.size() > 3) {
      part.max_range = evaluator_.number(*expr.operands[3]);
      if (!part.max_range) return {};
    }
    return plan_of(std::move(part));
  }

  static TubePlan plan_of(TubePart part) {
    TubePlan plan;
    plan.push_back(std::move(part));
    return plan;
  }

  // A value that holds cannot be missing.
  bool check_cells(const std::vector<Column>& columns, TubePart::Kind kind) {
    if (kind == TubePart::Kind::sampled) return true;
    for (const Column& column : columns) {
      for (std::size_t row = 0; row < column.cells.size(); ++row) {
        if (column.cells[row].kind == CellValue::Kind::number) continue;
        const bool blank = column.cells[row].kind == CellValue::Kind::blank;
        model_.diagnostics()
            .report(blank ? Code::blank_cell : Code::no_echo_here, column.table->range(row, column.index),
                    column.name())
            .note("`hold` needs a value in every row; `sampled` takes rows without one");
        return false;
      }
    }
    return true;
  }

  std::optional<TubePlan> with_error(const Expr& expr) {
    auto parts = plan(*expr.operands[0]);
    if (!parts) return {};
    const Expr& error = *expr.operands[1];
    const bool is_data = model_.type(error).is(Type::Kind::column);
    std::vector<Column> columns;
    Value numbers;
    if (is_data) {
      auto found = evaluator_.columns(error);
      if (!found) return {};
      columns = std::move(*found);
    } else {
      numbers = evaluator_.value(error);
      if (numbers.empty()) return {};
    }
    std::size_t component = 0;
    for (TubePart& part : *parts) {
      for (std::size_t i = 0; i < part.dim(); ++i, ++component) {
        const std::size_t at = std::max(columns.size(), numbers.size()) == 1 ? 0 : component;
        const bool good = is_data ? add_error(part, i, columns[at]) : add_error(part, i, numbers[at], error);
        if (!good) return {};
      }
    }
    return parts;
  }

  bool add_error(TubePart& part, std::size_t i, const Column& error) {
    for (std::size_t row = 0; row < error.cells.size(); ++row) {
      const CellValue& cell = error.cells[row];
      const SourceRange place = error.table->range(row, error.index);
      if (cell.kind != CellValue::Kind::number &&
          part.columns[i].cells[row].kind == CellValue::Kind::number) {
        model_.diagnostics()
            .report(Code::blank_cell, place, error.name())
            .note("the reading needs its error bound");
        return false;
      }
      if (cell.kind == CellValue::Kind::number && cell.number.enclosure.lo() < 0) {
        model_.diagnostics().report(Code::negative_error, place);
        return false;
      }
    }
    part.errors.emplace_back(error);
    return true;
  }

  bool add_error(TubePart& part, std::size_t i, const Term& error, const Expr& written) {
    const Number& e = std::get<Number>(error);
    if (e.enclosure.lo() < 0) {
      model_.diagnostics().report(Code::negative_error, written.range);
      return false;
    }
    if (part.kind == TubePart::Kind::constant) {
      part.domain[i] = part.domain[i] + join(-e.enclosure, e.enclosure);
      return true;
    }
    part.errors.emplace_back(e);
    return true;
  }

  Model& model_;
  Evaluator& evaluator_;
};

const Number* error_of(const TubePart& part, std::size_t component, std::size_t row) {
  if (part.errors.empty()) return nullptr;
  const auto& error = part.errors[component];
  if (const Number* everywhere = std::get_if<Number>(&error)) return everywhere;
  const CellValue& cell = std::get<Column>(error).cells[row];
  return cell.kind == CellValue::Kind::number ? &cell.number : nullptr;
}

// What a row says about a component.
Interval bound(const TubePart& part, std::size_t component, std::size_t row) {
  const CellValue& cell = part.columns[component].cells[row];
  const Number* error = error_of(part, component, row);
  const auto low = [&](const Number& n) { return error ? (n - *error).enclosure.lo() : n.enclosure.lo(); };
  const auto high = [&](const Number& n) { return error ? (n + *error).enclosure.hi() : n.enclosure.hi(); };
  switch (cell.kind) {
    case CellValue::Kind::number:
      return {low(cell.number), high(cell.number)};
    case CellValue::Kind::no_echo:
      return part.max_range ? Interval(low(*part.max_range), kInfinity) : Interval::entire();
    case CellValue::Kind::blank:
      break;
  }
  return Interval::entire();
}

class TubeBuilder {
 public:
  TubeBuilder(Model& model, const std::shared_ptr<const TimeLine>& line, std::size_t dim)
      : model_(model), line_(line), tube_(line, dim) {}

  bool add(const TubePart& part) {
    if (part.kind == TubePart::Kind::constant) {
      for (std::size_t c = 0; c < part.dim(); ++c) {
        for (std::size_t item = 0; item < line_->items(); ++item) tube_.set(first_ + c, item, part.domain[c]);
      }
    } else if (!add_rows(part)) {
      return false;
    }
    first_ += part.dim();
    return true;
  }

  GivenTube take() {
    std::vector<Reading> readings;
    for (auto& [gate, source] : readings_) readings.push_back({gate, std::move(source)});
    return {std::move(tube_), std::move(readings)};
  }

 private:
  bool add_rows(const TubePart& part) {
    const bool holds = part.kind == TubePart::Kind::hold;
    std::vector<double> stamps;
    std::vector<Box> values;
    for (std::size_t row = 0; row < part.stamps.size(); ++row) {
      const double stamp = part.stamps[row];
      const bool used = stamp <= line_->end() && (holds || stamp >= line_->start());
      if (!used) continue;
      Box value(static_cast<Eigen::Index>(part.dim()));
      for (std::size_t c = 0; c < part.dim(); ++c) value[static_cast<Eigen::Index>(c)] = bound(part, c, row);
      if (!holds) note_readings(part, row, value);
      stamps.push_back(stamp);
      values.push_back(std::move(value));
    }
    if (stamps.empty()) {
      model_.diagnostics()
          .report(Code::data_outside, part.range, line_->start(), line_->end())
          .note(fmt::format("the stamps run from {} to {}", part.stamps.front(), part.stamps.back()));
      return false;
    }
    const Tube made = holds ? hold(line_, stamps, values) : sampled(line_, stamps, values);
    for (std::size_t c = 0; c < part.dim(); ++c) {
      for (std::size_t item = 0; item < line_->items(); ++item) tube_.set(first_ + c, item, made.at(c, item));
    }
    return true;
  }

  void note_readings(const TubePart& part, std::size_t row, const Box& value) {
    for (std::size_t c = 0; c < part.dim(); ++c) {
      if (value[static_cast<Eigen::Index>(c)].is_entire()) continue;
      const Column& column = part.columns[c];
      std::string& source = readings_[*line_->gate_at(part.stamps[row])];
      if (!source.empty()) source += ", ";
      source.append(column.table->source().name()).append(":");
      source.append(std::to_string(column.table->line(row))).append(" column ").append(column.name());
    }
  }

  Model& model_;
  const std::shared_ptr<const TimeLine>& line_;
  Tube tube_;
  std::size_t first_ = 0;
  std::map<std::size_t, std::string> readings_;  // by gate
};

}  // namespace

std::optional<TubePlan> plan_tube(Model& model, Evaluator& evaluator, const Expr& expr) {
  return Planner(model, evaluator).plan(expr);
}

std::optional<GivenTube> build_tube(Model& model, const TubePlan& plan,
                                    const std::shared_ptr<const TimeLine>& line) {
  std::size_t dim = 0;
  for (const TubePart& part : plan) dim += part.dim();
  TubeBuilder builder(model, line, dim);
  for (const TubePart& part : plan) {
    if (!builder.add(part)) return {};
  }
  return builder.take();
}

}  // namespace hcsp::lang
