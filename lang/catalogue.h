// SPDX-License-Identifier: Apache-2.0
// The catalogue of diagnostics: every code with its message and the page that `hcsp-solve --explain CODE`
// prints. E0xx is syntax, E1xx names and types, E2xx data, E3xx time and sets, E4xx relations.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hcsp::lang {

enum class Code : std::uint16_t {
  unexpected = 1,
  bad_character = 2,
  broken_utf8 = 3,
  unterminated_string = 4,
  unterminated_comment = 5,
  too_deep = 6,
  malformed_number = 7,
  does_not_chain = 8,
  reserved_word = 9,
  not_supported = 10,
  unreadable_file = 11,
  include_cycle = 12,
  item_twice = 13,
  item_missing = 14,
  too_large = 15,

  unknown_name = 101,
  declared_twice = 102,
  unknown_function = 103,
  built_in_name = 104,
  cyclic_definition = 105,
  recursion = 106,
  wrong_type = 107,
  wrong_operands = 108,
  sizes_differ = 109,
  index_outside = 110,
  no_components = 111,
  wrong_argument_count = 112,
  domain_in_expression = 113,
  not_constant = 114,
  not_callable = 115,
  not_a_relation = 116,
  empty_interval = 117,
  undefined_constant = 118,
  unknown_parameter = 119,
  unknown_data = 120,
  unknown_dimension = 121,
  bad_size = 122,
  not_the_time = 123,
  misplaced_precision = 124,
  misplaced_infinity = 125,
  not_shown = 126,
  not_paved = 127,
  paved_twice = 128,

  unreadable_data = 201,
  unknown_column = 202,
  no_rows = 203,
  ragged_row = 204,
  not_a_number = 205,
  not_finite = 206,
  blank_cell = 207,
  stamps_unsorted = 208,
  stamp_twice = 209,
  row_outside = 210,
  no_echo_here = 211,
  broken_quotes = 212,
  column_twice = 213,
  rows_differ = 214,
  missing_cell = 215,
  broken_json = 216,

  no_time_line = 301,
  off_the_time_line = 302,
  bad_time_span = 303,
  bad_step = 304,
  too_many_instants = 305,
  bad_precision = 306,
  flat_frame = 307,
  no_precision = 308,
  negative_error = 309,
  precisions_differ = 310,
  bad_set_dimension = 311,
  out_of_range = 312,
  unbounded_frame = 313,
  data_outside = 314,
  no_grid = 315,
  no_gate = 316,
  no_polynomial = 317,
  undefined_tube = 318,

  der_misplaced = 401,
  der_of_what = 402,
  zone_over_time = 404,
};

struct CatalogueEntry {
  Code code;
  std::string_view format;       ///< of the message, in the notation of fmt
  std::string_view explanation;  ///< what it means and what to do
  std::string_view wrong;        ///< a model with the mistake, or a part of one
  std::string_view right;        ///< the same without
};

/// Every entry, by code.
std::span<const CatalogueEntry> catalogue();
const CatalogueEntry& entry(Code code);
/// E012.
std::string code_id(Code code);
/// The page of a code written as "E012" (or "e12", "12"); empty when there is none.
std::string explanation_page(std::string_view id);

}  // namespace hcsp::lang
