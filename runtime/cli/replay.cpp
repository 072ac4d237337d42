#include "zwang/runtime/replay.hpp"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "output.hpp"
#include "verbs.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string exactly(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

double period_of(const runtime::LogContext& context) {
  const auto period = context.facts.find("period [s]");
  if (period == context.facts.end()) throw Impossible("the log does not say its control period");
  const std::string& text = period->second;
  double seconds = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size())
    throw Impossible("`" + text + "` in the log is not a control period");
  return seconds;
}

constexpr std::size_t most_parts = 1000;

runtime::LogContents contents_of(const fs::path& log) {
  require_file(log.string());
  return runtime::read_log(log, [](double, std::string_view) {});
}

lang::Program program_of(const runtime::LogContext& context) {
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program = runtime::logged_program(context, diagnostics);
  if (program) return std::move(*program);
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  throw Impossible("the logged files do not load any more:\n" + text.str());
}

/// The log in the same folder where this one began, after a reload.
std::optional<fs::path> log_before(const fs::path& log, const runtime::LogContext& context) {
  const auto before = context.facts.find("continues");
  if (before == context.facts.end()) return std::nullopt;
  return log.parent_path() / fs::path(before->second).filename();
}

ordered_json as_json(const std::string& file, const runtime::ReplayResult& result, bool whole,
                     const std::string& version) {
  ordered_json first;
  if (result.first) {
    first = {{"time", result.first->time},
             {"column", result.first->column},
             {"logged", result.first->logged},
             {"computed", result.first->computed}};
  }
  return {{"file", file},   {"records", result.records}, {"equal", result.equal}, {"first_difference", first},
          {"whole", whole}, {"zwang", version}};
}

std::string as_text(const std::string& file, const runtime::ReplayResult& result, bool whole,
                    const std::string& version) {
  std::ostringstream out;
  out << file << ": " << result.records << " records, " << result.equal
      << " with the same torques to the last bit";
  out << (whole ? "\n" : "; the log is damaged\n");
  if (version != ZWANG_VERSION) out << "  logged by zwang " << version << ", replayed by " ZWANG_VERSION "\n";
  if (const auto& d = result.first) {
    out << "  first difference at " << with_unit(d->time, "s") << ": " << d->column << " was "
        << exactly(d->logged) << ", is " << exactly(d->computed) << "\n";
  }
  return out.str();
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  const runtime::LogContents log = contents_of(arguments.file);
  std::vector<runtime::ReplayPart> parts{{arguments.file, program_of(log.context)}};
  // A log that goes on where another one ends, and so on back to the begin of the run.
  for (std::optional<fs::path> before = log_before(arguments.file, log.context); before;) {
    if (parts.size() > most_parts) throw Impossible("its logs go on from one another without a begin");
    const runtime::LogContext context = contents_of(*before).context;
    parts.insert(parts.begin(), {*before, program_of(context)});
    before = log_before(*before, context);
  }
  const runtime::ReplayResult result = runtime::replay(parts, period_of(log.context));
  const bool whole = log.closed && log.damage.empty();
  const auto version = log.context.facts.find("zwang");
  const std::string by = version == log.context.facts.end() ? "?" : version->second;
  print(arguments.format == Format::json
            ? as_json(arguments.file, result, whole, by)
                      .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
                  "\n"
            : printable(as_text(arguments.file, result, whole, by)));
  return whole && result.records > 0 && result.equal == result.records ? exit_good : exit_bad;
}

}  // namespace zwang::cli
