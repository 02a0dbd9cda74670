// SPDX-License-Identifier: Apache-2.0
#include "lang/tool/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <optional>

#include "lang/data/file.h"
#include "lang/minibex/minibex.h"
#include "lang/syntax/format.h"
#include "lang/tool/files.h"
#include "lang/tool/summary.h"
#include "lang/tool/watch.h"
#include "solver/report/csv.h"
#include "solver/report/graph.h"
#include "solver/report/html.h"
#include "solver/report/json.h"
#include "solver/report/svg.h"
#include "solver/report/trace.h"

namespace hcsp::tool {

namespace {

std::atomic<bool> stop_asked{false};

// The first Ctrl-C ends the run with what it has, the next one the program.
extern "C" void on_signal(int signal) {
  stop_asked = true;
  std::signal(signal, SIG_DFL);
}

std::string written_as(const std::string& path, const Result& result, const Presentation& presentation) {
  const std::string ending = extension(path);
  if (ending == ".csv") return to_csv(result);
  if (ending == ".svg") return to_svg(result, presentation);
  if (ending == ".html") return to_html(result, presentation);
  return to_json(result);
}

bool draw_graph(const Options& options, const ContractorGraph& graph) {
  if (options.dump == "graph") fmt::print("{}", to_dot(graph));
  if (options.graph.empty()) return true;
  return write(options.graph, extension(options.graph) == ".dot" ? to_dot(graph) : graph_svg(graph));
}

bool shows_progress(const Options& options) { return !options.quiet && isatty(STDERR_FILENO) != 0; }

PropagationOptions propagation_options(const Options& options, double data_seconds) {
  PropagationOptions propagation;
  propagation.threads = options.threads;
  propagation.time_limit = options.time_limit;
  propagation.spent_before = data_seconds;
  propagation.cancel = &stop_asked;
  propagation.keep_trace = !options.trace.empty();
  propagation.keep_snapshots =
      std::any_of(options.outputs.begin(), options.outputs.end(),
                  [](const std::string& path) { return extension(path) == ".html"; });
  if (shows_progress(options)) {
    propagation.progress = [](std::uint64_t pass, double seconds) {
      constexpr double kWorthTelling = 0.5;
      if (seconds > kWorthTelling) fmt::print(stderr, "\rpass {}, {:.1f} s", pass, seconds);
    };
  }
  return propagation;
}

SearchOptions search_options(const Options& options, const lang::CompiledModel& model,
                             SearchProgress& progress) {
  SearchOptions search;
  search.precision = options.precision > 0 ? options.precision : model.precision;
  if (options.precision == 0) search.absolute_precision = model.absolute_precision;
  search.order = options.order;
  search.bisector = options.bisector;
  search.threads = options.threads;
  search.time_limit = options.time_limit;
  search.spent_before = model.data_seconds;
  search.cancel = &stop_asked;
  search.progress = &progress;
  if (!options.checkpoint.empty())
    search.checkpoint = [&](const std::string& state) { write_at_once(options.checkpoint, state); };
  return search;
}

Result answer(const lang::CompiledModel& model, const SearchOptions& search) {
  if (model.goal == lang::SolveItem::Goal::minimize) return model.problem->minimize(*model.objective, search);
  if (model.goal == lang::SolveItem::Goal::maximize) return model.problem->maximize(*model.objective, search);
  if (model.goal == lang::SolveItem::Goal::pave) return model.problem->pave(model.paved, search);
  return model.problem->solve_all(search);
}

// Nothing, after a message, where there is no going on from the checkpoint.
std::optional<Result> search(const Options& options, const lang::CompiledModel& model) {
  SearchProgress progress;
  SearchOptions search = search_options(options, model, progress);
  std::string error;
  auto state = options.resume.empty() ? std::string() : lang::read_file(options.resume, error);
  try {
    if (state) {
      search.resume = std::move(*state);
      const Watch watch(options.memory_limit, stop_asked, shows_progress(options) ? &progress : nullptr);
      return answer(model, search);
    }
  } catch (const std::invalid_argument& refused) {
    if (options.resume.empty()) throw;
    error = refused.what();
  }
  fmt::print(stderr, "hcsp-solve: --resume {}: {}\n", options.resume, error);
  return {};
}

std::optional<Result> solve(const Options& options, const lang::CompiledModel& model) {
  if (model.goal != lang::SolveItem::Goal::propagate) return search(options, model);
  const Watch watch(options.memory_limit, stop_asked, nullptr);
  const PropagationOptions propagation = propagation_options(options, model.data_seconds);
  const Result result = model.problem->propagate(propagation);
  if (propagation.progress) fmt::print(stderr, "\r\033[K");
  return result;
}

bool write_outputs(const Options& options, const Result& result, Presentation presentation) {
  if (!options.truth.empty()) {
    std::string error;
    const auto text = lang::read_file(options.truth, error);
    if (text) presentation.truth = read_truth(*text, result, error);
    if (!presentation.truth) {
      fmt::print(stderr, "hcsp-solve: --truth {}: {}\n", options.truth, error);
      return false;
    }
  }
  bool good = true;
  for (const std::string& path : options.outputs)
    good = write(path, written_as(path, result, presentation)) && good;
  if (!options.trace.empty()) good = write(options.trace, trace_json(result)) && good;
  return good;
}

int solve_and_tell(const Options& options, const lang::CompiledModel& model) {
  const bool writable =
      std::all_of(options.outputs.begin(), options.outputs.end(), can_write) && can_write(options.trace);
  if (!writable) return kWrongInput;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const std::optional<Result> result = solve(options, model);
  if (!result) return kWrongInput;
  if (!options.quiet) fmt::print("{}", summary(*result, model.shown));
  if (!write_outputs(options, *result, {model.shown, {}})) return kWrongInput;
  return result->status == Status::limit ? kStopped : kFinished;
}

int explain(const std::string& code) {
  const std::string page = lang::explanation_page(code);
  if (page.empty()) {
    fmt::print(stderr, "hcsp-solve: there is no diagnostic {}\n", code);
    return kWrongUsage;
  }
  fmt::print("{}", page);
  return kFinished;
}

int not_of_minibex(std::string_view option) {
  fmt::print(stderr, "hcsp-solve: {} is not there for Minibex files\n", option);
  return kWrongUsage;
}

// Whether the goal makes use of the options of a search that were given.
bool are_of_use(const Options& options, lang::SolveItem::Goal goal) {
  using Goal = lang::SolveItem::Goal;
  for (const std::string_view option : options.of_search) {
    const bool is_of_cuts = option == "--order" || option == "--bisector";
    if (goal == Goal::propagate) {
      fmt::print(stderr, "hcsp-solve: {}: `solve propagate` searches nothing\n", option);
    } else if (goal == Goal::pave && is_of_cuts) {
      fmt::print(stderr, "hcsp-solve: {}: `solve pave` cuts all boxes, across the widest side\n", option);
    } else {
      continue;
    }
    return false;
  }
  return true;
}

int format(const Options& options) {
  if (lang::minibex::is_minibex(options.model)) return not_of_minibex("--format");
  std::string error;
  auto text = lang::read_file(options.model, error);
  if (!text) {
    fmt::print(stderr, "hcsp-solve: cannot read {}: {}\n", options.model, error);
    return kWrongInput;
  }
  lang::Diagnostics diagnostics;
  const lang::Source source(options.model, std::move(*text));
  const auto formatted = lang::format(source, diagnostics);
  if (!formatted) {
    fmt::print(stderr, "{}", diagnostics.text());
    return kWrongInput;
  }
  if (options.outputs.empty()) fmt::print("{}", *formatted);
  const bool written = std::all_of(options.outputs.begin(), options.outputs.end(),
                                   [&](const std::string& path) { return write(path, *formatted); });
  return written ? kFinished : kWrongInput;
}

}  // namespace

int run(const Options& options) {
  if (!options.explain.empty()) return explain(options.explain);
  if (options.format) return format(options);
  if (options.dump == "ast" && lang::minibex::is_minibex(options.model)) return not_of_minibex("--dump ast");
  if (!can_write(options.checkpoint)) return kWrongInput;
  lang::Compilation compilation = lang::compile_file(options.model, options.compile);
  if (options.dump == "ast") fmt::print("{}", lang::dump(*compilation.tree));
  if (options.dump == "types") fmt::print("{}", compilation.types);
  if (!compilation.model) {
    fmt::print(stderr, "{}", compilation.diagnostics.text());
    return kWrongInput;
  }
  if (!are_of_use(options, compilation.model->goal)) return kWrongUsage;
  if (!draw_graph(options, compilation.model->problem->graph())) return kWrongInput;
  if (options.check_only || !options.dump.empty()) return kFinished;
  return solve_and_tell(options, *compilation.model);
}

}  // namespace hcsp::tool
