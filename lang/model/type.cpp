// SPDX-License-Identifier: Apache-2.0
#include "lang/model/type.h"

#include <fmt/format.h>

namespace hcsp::lang {

std::string describe(const Type& type) {
  const std::string size = type.dim == 0 ? "" : fmt::format("[{}]", type.dim);
  const std::string lifted = fmt::format("{}real{}", type.tube ? "tube " : "", size);
  switch (type.kind) {
    case Type::Kind::error:
      return "an error";
    case Type::Kind::boolean:
      return type.tube ? "a relation at each instant" : "a relation";
    case Type::Kind::real:
      return fmt::format("`{}`", lifted);
    case Type::Kind::domain:
      return "a domain of `" + lifted + "`";
    case Type::Kind::set:
      return fmt::format("`set real{}`", size);
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
