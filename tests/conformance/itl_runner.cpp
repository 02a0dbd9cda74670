// SPDX-License-Identifier: Apache-2.0
// itl_runner FILE...: runs test cases of IEEE 1788 (ITF1788, ITL format) on the library. A line a file and a
// total; exit status 0 when no case fails, 1 when one does, 2 when a file cannot be read.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>

#include "domains/interval/kernel.h"
#include "domains/interval/numeric.h"
#include "tests/conformance/itl_reader.h"
#include "tests/conformance/operations.h"

namespace hcsp::itl {
namespace {

using D = DecoratedInterval;

/// From best to worst. A reverse operation passes, counted apart, when it is an ulp wider than expected, or
/// tighter: the suite's results are not always the tightest. So does a constructor that finds a literal's
/// bounds out of order where the suite leaves this undecided (PossiblyUndefinedOperation).
enum class Verdict : std::uint8_t { passed, within_an_ulp, tighter, decided, failed };
constexpr const char* kVerdicts[] = {"passed", "within an ulp", "tighter", "decided", "failed"};

std::string told(const Value& value) {
  if (const auto* literal = std::get_if<Literal>(&value)) {
    const D& d = literal->value;
    const Interval& a = d.interval();
    const std::string text =
        d.is_nai() ? "[nai]" : (a.is_empty() ? "[empty]" : fmt::format("[{:a}, {:a}]", a.lo(), a.hi()));
    const std::string whole = to_string(d);
    return literal->is_decorated && !d.is_nai() ? text + whole.substr(whole.rfind('_')) : text;
  }
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:a}", *number);
  if (const auto* word = std::get_if<Word>(&value)) return word->name;
  return "?";
}

Verdict judged(const Interval& got, const Interval& expected, bool is_reverse) {
  if (got == expected) return Verdict::passed;
  if (is_reverse && subset(got, expected)) return Verdict::tighter;
  const bool encloses = is_reverse && !expected.is_empty() && subset(expected, got);
  const bool is_tight = got.lo() >= up::next_down(expected.lo()) && got.hi() <= up::next_up(expected.hi());
  return encloses && is_tight ? Verdict::within_an_ulp : Verdict::failed;
}

Verdict judged(const Value& got, const Value& expected, bool is_reverse) {
  if (got.index() != expected.index()) return Verdict::failed;
  if (const auto* literal = std::get_if<Literal>(&expected)) {
    const D &a = std::get<Literal>(got).value, &b = literal->value;
    if (literal->is_decorated && a.decoration() != b.decoration()) return Verdict::failed;
    return judged(a.interval(), b.interval(), is_reverse);
  }
  if (const auto* number = std::get_if<double>(&expected)) {
    const double x = std::get<double>(got);
    return x == *number || (std::isnan(x) && std::isnan(*number)) ? Verdict::passed : Verdict::failed;
  }
  const bool same = std::get<Word>(got).name == std::get<Word>(expected).name;
  return same ? Verdict::passed : Verdict::failed;
}

Verdict judged(const Outcome& got, const Statement& statement, bool is_reverse) {
  if (got.results.size() != statement.results.size()) return Verdict::failed;
  if (got.is_undefined && statement.signal == "PossiblyUndefinedOperation") return Verdict::decided;
  if (got.is_undefined != (statement.signal == "UndefinedOperation")) return Verdict::failed;
  Verdict worst = Verdict::passed;
  for (std::size_t i = 0; i < got.results.size(); ++i)
    worst = std::max(worst, judged(got.results[i], statement.results[i], is_reverse));
  return worst;
}

struct Count {
  std::array<int, std::size(kVerdicts)> verdicts{};
  std::map<std::string, int> skipped;

  [[nodiscard]] int of(Verdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
  Count& operator+=(const Count& other) {
    for (std::size_t i = 0; i < verdicts.size(); ++i) verdicts[i] += other.verdicts[i];
    for (const auto& [reason, n] : other.skipped) skipped[reason] += n;
    return *this;
  }
};

std::string told(const Outcome& outcome) {
  std::string text;
  for (const Value& value : outcome.results) text += " " + told(value);
  return text + (outcome.is_undefined ? " signal UndefinedOperation" : "");
}

void run(const std::string& file, const Statement& statement, Count& count) {
  const auto found = operations().find(statement.operation);
  if (found == operations().end()) {
    ++count.skipped[statement.operation + " is not supported"];
    return;
  }
  Verdict verdict = Verdict::failed;
  std::string got;
  try {
    const Outcome outcome = found->second.run(statement.operands);
    verdict = judged(outcome, statement, found->second.is_reverse);
    got = told(outcome);
  } catch (const std::exception& error) {
    got = fmt::format(" an error: {}", error.what());
  }
  const char* name = kVerdicts[static_cast<std::size_t>(verdict)];
  if (verdict >= Verdict::tighter)
    fmt::print("{}:{}: {}: {}\n  got{}\n", file, statement.line, name, statement.text, got);
  ++count.verdicts[static_cast<std::size_t>(verdict)];
}

void print(const std::string& name, const Count& count) {
  int skipped = 0;
  for (const auto& [reason, n] : count.skipped) skipped += n;
  fmt::print("{}: {} passed, apart from {} within an ulp, {} tighter, {} decided; {} failed, {} skipped\n",
             name, count.of(Verdict::passed), count.of(Verdict::within_an_ulp), count.of(Verdict::tighter),
             count.of(Verdict::decided), count.of(Verdict::failed), skipped);
  for (const auto& [reason, n] : count.skipped) fmt::print("  skipped {}: {}\n", n, reason);
}

int run_all(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: itl_runner FILE...\n");
    return 2;
  }
  Count total;
  for (int i = 1; i < argc; ++i) {
    Count count;
    for (const Statement& statement : read(argv[i])) run(argv[i], statement, count);
    print(argv[i], count);
    total += count;
  }
  print("total", total);
  return total.of(Verdict::failed) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace hcsp::itl

int main(int argc, char** argv) {
  try {
    return hcsp::itl::run_all(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
