#include "zwang/runtime/replay.hpp"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "output.hpp"
#include "run_log.hpp"
#include "verbs.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/version.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string exactly(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

constexpr std::size_t most_parts = 100'000;

runtime::LogContents contents_of(const fs::path& log) {
  require_log(log.string());
  return runtime::read_log(log, [](double, std::span<const double>) {});
}

lang::Program program_of(const runtime::LogContext& context) {
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program = runtime::logged_program(context, diagnostics);
  if (program) return std::move(*program);
  throw Impossible("the logged files do not load any more:\n" + rendered(diagnostics));
}

/// The log in the same folder where this one began, after a reload.
std::optional<fs::path> log_before(const fs::path& log, const runtime::LogContext& context) {
  const auto before = context.facts.find("continues");
  if (before == context.facts.end()) return std::nullopt;
  const fs::path path = log.parent_path() / fs::path(before->second).filename();
  std::error_code error;
  if (!fs::exists(path, error))
    throw Impossible(log.string() + " goes on from " + path.string() +
                     ", which is not there: a replay begins where the run began");
  return path;
}

std::string fact(const runtime::LogContext& context, const char* name) {
  const auto found = context.facts.find(name);
  return found == context.facts.end() ? "?" : found->second;
}

ordered_json as_json(const std::string& file, const runtime::ReplayResult& result, bool whole,
                     const runtime::LogContext& context) {
  ordered_json first;
  if (result.first) {
    first = {{"time", result.first->time},
             {"column", result.first->column},
             {"logged", result.first->logged},
             {"computed", result.first->computed}};
  }
  return {{"file", file},          {"records", result.records},
          {"equal", result.equal}, {"first_difference", first},
          {"whole", whole},        {"zwang", fact(context, "zwang")}};
}

std::string as_text(const std::string& file, const runtime::ReplayResult& result, bool whole,
                    const runtime::LogContext& context) {
  std::ostringstream out;
  out << file << ": " << result.records << " records, " << result.equal
      << " with the same torques to the last bit";
  out << (whole ? "\n" : "; the log is damaged\n");
  const std::string version = fact(context, "zwang"), compiler = fact(context, "compiler");
  if (version != ZWANG_VERSION) out << "  logged by zwang " << version << ", replayed by " ZWANG_VERSION "\n";
  if (compiler != __VERSION__)
    out << "  logged by a program of the compiler " << compiler << ", replayed by one of " __VERSION__ "\n";
  if (const auto& d = result.first) {
    out << "  first difference at " << with_unit(d->time, "s") << ": " << d->column << " was "
        << exactly(d->logged) << ", is " << exactly(d->computed) << "\n";
  }
  return out.str();
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  require_log(arguments.file);
  const fs::path file = runtime::log_files(arguments.file).back();
  const runtime::LogContents log = contents_of(file);
  std::vector<runtime::ReplayPart> parts{{file, program_of(log.context)}};
  // A log may continue another one. Each one is followed back to the start of the run.
  bool is_part = log.context.facts.contains(runtime::part_fact);
  for (std::optional<fs::path> before = log_before(file, log.context); before;) {
    if (parts.size() > most_parts) throw Impossible("its logs go on from one another without a begin");
    const runtime::LogContext context = contents_of(*before).context;
    parts.front().has_program_of_before = is_part;
    is_part = context.facts.contains(runtime::part_fact);
    parts.insert(parts.begin(), {*before, program_of(context)});
    before = log_before(*before, context);
  }
  const runtime::ReplayResult result = runtime::replay(parts, runtime::logged_settings(log.context));
  const bool whole = log.closed && log.damage.empty();
  if (arguments.format == Format::json) {
    print_data(as_json(arguments.file, result, whole, log.context)
                   .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
               "\n");
  } else {
    print(as_text(arguments.file, result, whole, log.context));
  }
  return whole && result.records > 0 && result.equal == result.records ? exit_good : exit_bad;
}

}  // namespace zwang::cli
