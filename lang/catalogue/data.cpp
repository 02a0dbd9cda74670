// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lang/catalogue/entries.h"

namespace hcsp::lang {

#define HCSP_SAMPLED(file) \
  "data log = csv(\"" file \
  "\");\ntime t in [0, 1] step 0.1;\ngiven z : tube real = sampled(log.t, log.range);"
#define HCSP_HELD(file) \
  "data log = csv(\"" file "\");\ntime t in [0, 1] step 0.1;\ngiven z : tube real = hold(log.t, log.range);"

std::span<const CatalogueEntry> data_entries() {
  static constexpr std::array kEntries{
      CatalogueEntry{
          Code::unreadable_data, "cannot read `{}`: {}",
          "The file of a `data` item does not exist or may not be read. Paths in a model are relative to\n"
          "its folder, those after --data to the working folder.",
          HCSP_SAMPLED("lgo.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{
          Code::unknown_column, "{} has no column `{}`",
          "The header line of the file names its columns. A name that is no identifier is written\n"
          "log.\"speed (m/s)\".",
          "data log = csv(\"log.csv\");\ntime t in [0, 1] step 0.1;\n"
          "given z : tube real = sampled(log.t, log.rnage);",
          HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::no_rows, "the file has {}", "A data file has a header line and at least one row.",
                     HCSP_SAMPLED("empty.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::ragged_row, "the row has {} cells, the header {}",
                     "A row has a cell more than there are columns. A comma in a text needs quotes around "
                     "the text, and\n"
                     "a decimal comma is not understood.",
                     HCSP_SAMPLED("long_row.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::not_a_number, "column `{}`: `{}` is not a number",
                     "A cell is a decimal number, blank, or the word oo.", HCSP_SAMPLED("text.csv"),
                     HCSP_SAMPLED("log.csv")},
      CatalogueEntry{
          Code::not_finite, "column `{}`: `{}` is no reading",
          "NaN and infinities of a logger are no numbers. Leave the cell blank where nothing was read; a\n"
          "rangefinder that saw no echo writes oo.",
          HCSP_SAMPLED("nan.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{
          Code::blank_cell, "column `{}`: the cell is blank",
          "A blank cell is no reading, which `sampled` takes. A value that holds, a stamp, an error bound\n"
          "and a single cell that the model names have to be there.",
          HCSP_HELD("blank.csv"), HCSP_SAMPLED("blank.csv")},
      CatalogueEntry{Code::stamps_unsorted, "column `{}`: the stamp {} follows {}",
                     "Stamps increase from row to row. Sort the file.", HCSP_SAMPLED("unsorted.csv"),
                     HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::stamp_twice, "column `{}`: the stamp {} is there twice",
                     "Two rows have one stamp: the readings may contradict each other. Remove one.",
                     HCSP_SAMPLED("twice.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::row_outside, "the row {} is not between {} and {}",
                     "Rows are counted from 1, without the header.",
                     "data log = csv(\"log.csv\");\nlet a = log.t[1000];",
                     "data log = csv(\"log.csv\");\nlet a = log.t[1];"},
      CatalogueEntry{Code::no_echo_here, "column `{}`: `oo` says that there was no echo, it is no number",
                     "oo is for the ranges that `sampled` takes.", HCSP_HELD("no_echo.csv"),
                     HCSP_SAMPLED("no_echo.csv")},
      CatalogueEntry{Code::broken_quotes, "this quoted cell {}",
                     "A cell that starts with a double quote ends with one; a quote within is written twice.",
                     HCSP_SAMPLED("quotes.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::column_twice, "two columns are called `{}`", "Columns are found by name.",
                     HCSP_SAMPLED("two_columns.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{
          Code::rows_differ, "{} and {} do not have the same rows",
          "Columns that are combined, and the stamps of values, come from one table.",
          "data log = csv(\"log.csv\");\ndata log2 = csv(\"second.csv\");\ntime t in [0, 1] step 0.1;\n"
          "given z : tube real = sampled(log.t, log2.range);",
          HCSP_SAMPLED("log.csv")},
      CatalogueEntry{Code::missing_cell, "column `{}`: the row ends before its cell",
                     "The row has fewer cells than the header. A blank cell keeps its comma.",
                     HCSP_SAMPLED("short_row.csv"), HCSP_SAMPLED("log.csv")},
      CatalogueEntry{
          Code::broken_json, "this is no table in JSON: {}",
          "A table in JSON is an object of columns, {\"t\": [0, 0.1], \"range\": [5, null]}, or an array of\n"
          "rows, [{\"t\": 0, \"range\": 5}, {\"t\": 0.1}]. null is a blank cell.",
          "data log = json(\"broken.json\");\ntime t at log.t;",
          "data log = json(\"log.json\");\ntime t at log.t;"},
  };
  return kEntries;
}

#undef HCSP_SAMPLED
#undef HCSP_HELD

}  // namespace hcsp::lang
