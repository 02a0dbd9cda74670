// SPDX-License-Identifier: Apache-2.0
#include "lang/model/type.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lang/model/model.h"

namespace hcsp::lang {

std::vector<std::size_t> Type::sizes() const {
  std::vector<std::size_t> all;
  for (const Extent& extent : arrays) all.push_back(extent.size());
  if (dim != 0) all.push_back(dim);
  if (columns != 0) all.push_back(columns);
  return all;
}

std::size_t Type::components() const {
  return std::size_t{std::max(dim, 1U)} * std::size_t{std::max(columns, 1U)};
}

std::size_t Type::terms() const {
  std::size_t all = components();
  for (const Extent& extent : arrays) all *= extent.size();
  return all;
}

Type Type::element() const {
  Type type = *this;
  type.arrays.clear();
  return type;
}

Extent index_range(const Type& type) {
  if (type.is(Type::Kind::column)) return {1, static_cast<int>(type.data->table->rows())};
  return type.is_array() ? type.arrays.front() : Extent{1, static_cast<int>(type.dim)};
}

Type component_of(const Type& type) {
  Type component = type;
  if (type.is(Type::Kind::column)) {
    component.kind = Type::Kind::real;
    component.data = nullptr;
  } else if (type.is_array()) {
    component.arrays.erase(component.arrays.begin());
  } else {
    component.dim = std::exchange(component.columns, 0);
  }
  return component;
}

std::string describe(const Type& type) {
  const std::string size = type.is_matrix() ? fmt::format("[{}, {}]", type.dim, type.columns)
                           : type.dim == 0  ? ""
                                            : fmt::format("[{}]", type.dim);
  std::string arrays;
  for (const Extent& extent : type.arrays)
    arrays += fmt::format("{}{}..{}", arrays.empty() ? "array[" : ", ", extent.first, extent.last);
  if (!arrays.empty()) arrays += "] of ";
  const std::string lifted =
      fmt::format("{}{}{}{}", arrays, type.tube ? "tube " : "", type.whole ? "int" : "real", size);
  switch (type.kind) {
    case Type::Kind::error:
      return "an error";
    case Type::Kind::boolean:
      if (type.is_array()) return fmt::format("`{}bool`", arrays);
      return type.tube ? "a relation at each instant" : "a relation";
    case Type::Kind::real:
      return fmt::format("`{}`", lifted);
    case Type::Kind::domain:
      return "a domain of `" + lifted + "`";
    case Type::Kind::set:
      return fmt::format("`{}set real{}`", arrays, size);
    case Type::Kind::column:
      return type.dim == 0 ? "a column of data" : fmt::format("{} columns of data", type.dim);
    case Type::Kind::table:
      return "a table of data";
    case Type::Kind::text:
      return "a text";
    case Type::Kind::range:
      return "a range of whole numbers";
  }
  return {};
}

}  // namespace hcsp::lang
