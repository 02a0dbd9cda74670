// SPDX-License-Identifier: Apache-2.0
#include "solver/report/trace.h"

#include "solver/report/text.h"

namespace hcsp {

namespace {

using report::put;
using report::put_json_number;
using report::put_json_string;
using report::TextBuffer;

void put_bounds(TextBuffer& out, const std::vector<Interval>& components) {
  put(out, '[');
  for (const Interval& component : components) {
    if (&component != components.data()) put(out, ", ");
    if (component.is_empty()) {
      put(out, "null");
      continue;
    }
    put(out, '[');
    put_json_number(out, component.lo());
    put(out, ", ");
    put_json_number(out, component.hi());
    put(out, ']');
  }
  put(out, ']');
}

void put_change(TextBuffer& out, const TraceEntry::Change& change) {
  put(out, "\n        { \"time\": [");
  put_json_number(out, change.time[0]);
  put(out, ", ");
  put_json_number(out, change.time[1]);
  put(out, "], \"before\": ");
  put_bounds(out, change.before);
  put(out, ", \"after\": ");
  put_bounds(out, change.after);
  put(out, " }");
}

void put_entry(TextBuffer& out, const TraceEntry& entry) {
  fmt::format_to(fmt::appender(out), "    {{ \"pass\": {}, \"contractor\": ", entry.pass);
  put_json_string(out, entry.contractor);
  put(out, ", \"variable\": ");
  put_json_string(out, entry.variable);
  put(out, ", \"before\": ");
  put_json_number(out, entry.measure_before);
  put(out, ", \"after\": ");
  put_json_number(out, entry.measure_after);
  put(out, ",\n      \"changes\": [");
  for (const TraceEntry::Change& change : entry.changes) {
    if (&change != entry.changes.data()) put(out, ',');
    put_change(out, change);
  }
  put(out, "] }");
}

}  // namespace

std::string trace_json(const Result& result) {
  TextBuffer out;
  put(out, "{ \"hcsp\": \"" HCSP_VERSION "\", \"model\": ");
  put_json_string(out, result.model);
  put(out, ",\n  \"trace\": [\n");
  for (const TraceEntry& entry : result.trace) {
    if (&entry != result.trace.data()) put(out, ",\n");
    put_entry(out, entry);
  }
  put(out, "\n  ] }\n");
  return report::to_text(out);
}

}  // namespace hcsp
