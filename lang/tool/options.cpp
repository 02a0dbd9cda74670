// SPDX-License-Identifier: Apache-2.0
#include "lang/tool/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>

#include "lang/tool/run.h"

namespace hcsp::tool {

namespace {

struct Written {
  std::vector<std::string> parameters;
  std::vector<std::string> data;
};

const std::map<std::string, SearchOrder> kOrders{{"depth", SearchOrder::depth_first},
                                                 {"best", SearchOrder::best_first}};
const std::map<std::string, Bisector> kBisectors{{"smear", Bisector::smear},
                                                 {"smear-max", Bisector::smear_max},
                                                 {"largest", Bisector::largest_first},
                                                 {"round-robin", Bisector::round_robin}};

// Options that `solve propagate` has no use for.
constexpr std::array kOfSearch{"--precision", "--order", "--bisector", "--checkpoint", "--resume"};

const CLI::Validator kPositive(
    [](std::string& text) {
      double value = 0.0;
      const bool good = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
      return good ? std::string() : fmt::format("`{}` is no number above 0", text);
    },
    "");

void declare_search(CLI::App& app, Options& options) {
  app.add_option(
         "--precision", options.precision,
         "Of a search, in place of the model's: no box is cut finer; of an optimisation, the absolute or "
         "relative width of the bracket")
      ->check(kPositive)
      ->option_text("P");
  app.add_option("--order", options.order,
                 "Of a search: depth (first) or best (first, as an optimisation is by itself)")
      ->transform(CLI::Transformer(kOrders))
      ->option_text("ORDER");
  app.add_option("--bisector", options.bisector,
                 "Of a search, which unknown is cut: smear, smear-max, largest or round-robin")
      ->transform(CLI::Transformer(kBisectors))
      ->option_text("WHICH");
  app.add_option("--checkpoint", options.checkpoint,
                 "Keep the state of a search in FILE as it goes, so that --resume can go on from there")
      ->option_text("FILE");
  app.add_option("--resume", options.resume, "Go on with a search that was stopped or killed")
      ->option_text("FILE");
}

void declare(CLI::App& app, Options& options, Written& written) {
  app.add_option("MODEL", options.model,
                 "The model: a .hcsp file, or a Minibex file of IBEX (.bch, .mbx, .txt)")
      ->option_text(" ");
  app.add_option("--set", written.parameters, "NAME=VALUE: replace the value of a param (may repeat)")
      ->allow_extra_args(false)
      ->option_text("NAME=VALUE");
  app.add_option("--data", written.data, "NAME=FILE: replace the file of a data item (may repeat)")
      ->allow_extra_args(false)
      ->option_text("NAME=FILE");
  app.add_option("-o,--output", options.outputs,
                 "Write the result, in the format of the ending: .json .csv .svg .html (may repeat)")
      ->allow_extra_args(false)
      ->option_text("FILE");
  app.add_option("--threads", options.threads, "Threads to use")
      ->check(CLI::Range(1U, 1024U))
      ->option_text("N");
  app.add_option("--time-limit", options.time_limit, "Stop after S seconds; the domains are still guaranteed")
      ->check(kPositive)
      ->option_text("S");
  app.add_option("--memory-limit", options.memory_limit,
                 "Stop when the process holds more than MB megabytes, as at a time limit")
      ->check(kPositive)
      ->option_text("MB");
  declare_search(app, options);
  app.add_flag("--check", options.check_only, "Read and check the model and its data, solve nothing");
  app.add_flag("--format", options.format,
               "Print the model in the canonical layout; -o FILE.hcsp writes it, to the model itself too");
  app.add_option("--explain", options.explain, "Print the page of a diagnostic code, such as E101")
      ->option_text("CODE");
  app.add_option("--dump", options.dump, "Print what a phase makes of the model: ast, types or graph")
      ->check(CLI::IsMember({"ast", "types", "graph"}))
      ->option_text("PHASE");
  app.add_option("--graph", options.graph, "Draw the contractor graph: .dot or .svg")->option_text("FILE");
  app.add_option("--trace", options.trace, "Write what each contractor removed in each pass")
      ->option_text("FILE.json");
  app.add_option("--truth", options.truth, "True trajectories to draw: columns t, x1, x2, ...")
      ->option_text("FILE.csv");
  app.add_flag("--quiet", options.quiet, "Print nothing but errors");
  app.set_version_flag("--version", "hcsp-solve " HCSP_VERSION);
  app.footer(
      "Exit status: 0 the run came to its end (its status says whether feasible), 1 the model or its data is "
      "wrong or\n"
      "a file cannot be written, 2 wrong usage, 3 stopped by a limit or Ctrl-C (what was computed is "
      "written).");
}

// NAME=TEXT, into a map.
bool split(const std::vector<std::string>& written, std::string_view option,
           std::map<std::string, std::string>& map) {
  for (const std::string& text : written) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      fmt::print(stderr, "hcsp-solve: {} takes NAME=VALUE, not `{}`\n", option, text);
      return false;
    }
    map[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return true;
}

bool has_ending(const std::string& path, std::string_view option,
                std::initializer_list<std::string_view> known) {
  if (std::find(known.begin(), known.end(), extension(path)) != known.end()) return true;
  fmt::print(stderr, "hcsp-solve: {} `{}`: the name has to end in {}\n", option, path,
             fmt::join(known, ", "));
  return false;
}

// What CLI11 cannot check.
bool is_usable(const Options& options) {
  if (options.explain.empty() && options.model.empty()) {
    fmt::print(stderr, "hcsp-solve: which model? Try hcsp-solve --help\n");
    return false;
  }
  const bool outputs =
      std::all_of(options.outputs.begin(), options.outputs.end(), [&](const std::string& path) {
        if (options.format) return has_ending(path, "-o", {".hcsp"});
        return has_ending(path, "-o", {".json", ".csv", ".svg", ".html"});
      });
  return outputs && (options.graph.empty() || has_ending(options.graph, "--graph", {".dot", ".svg"}));
}

}  // namespace

std::string extension(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string ending = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

ParsedOptions parse_options(int argc, char** argv) {
  Options options;
  Written written;
  CLI::App app("Solves hybrid constraint problems with guaranteed answers.", "hcsp-solve");
  declare(app, options, written);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return {{}, app.exit(error)};
    fmt::print(stderr, "hcsp-solve: {}\nTry hcsp-solve --help\n", error.what());
    return {{}, kWrongUsage};
  }
  const bool good = is_usable(options) && split(written.parameters, "--set", options.compile.parameters) &&
                    split(written.data, "--data", options.compile.data_files);
  if (!good) return {{}, kWrongUsage};
  for (const char* const name : kOfSearch) {
    if (app.count(name) > 0) options.of_search.emplace_back(name);
  }
  return {std::move(options), 0};
}

}  // namespace hcsp::tool
