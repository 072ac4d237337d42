#include "output.hpp"
#include "run_log.hpp"
#include "verbs.hpp"
#include "zwang/runtime/log_csv.hpp"

namespace zwang::cli {

namespace {

void tell_damage(const std::string& run, const runtime::LogContents& log) {
  for (const std::string& what : log.damage) print_error("zwang: " + run + ": " + what + "\n");
}

}  // namespace

int log(const LogArguments& arguments) {
  require_log(arguments.run);
  runtime::LogContents log;
  if (arguments.out) {
    require_place_of_result(*arguments.out);
    OutputFile file(*arguments.out);
    log = runtime::log_as_csv(arguments.run, [&file](std::string_view text) { file.write(text); });
    file.finish();
  } else {
    log = runtime::log_as_csv(arguments.run, [](std::string_view text) { print_data(text); });
  }
  tell_damage(arguments.run, log);
  return log.closed && log.damage.empty() ? exit_good : exit_bad;
}

}  // namespace zwang::cli
