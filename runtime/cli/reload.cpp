#include "reload.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "output.hpp"
#include "scenario_choice.hpp"
#include "zwang/lang/start.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
constexpr auto look_every = std::chrono::milliseconds(50);

}  // namespace

Reloads::Reloads(const RunArguments& arguments, fs::path folder, const lang::Diagnostics& diagnostics,
                 const runtime::RunnerSettings& settings, Recorders& recorders)
    : arguments_(arguments),
      folder_(std::move(folder)),
      first_(diagnostics),
      settings_(settings),
      recorders_(recorders) {
  for (const lang::Source& source : diagnostics.sources()) {
    std::error_code error;
    if (fs::is_regular_file(source.path, error)) files_.push_back(source.path);
  }
  thread_ = std::thread([this] { watch(); });
}

std::optional<lang::Program> load(const RunArguments& arguments, lang::Diagnostics& diagnostics) {
  if (arguments.choice) return load_choice(*arguments.choice, diagnostics);
  const lang::Start start{arguments.start_at, arguments.start_yaw};
  return lang::load_from(start, arguments.file, arguments.overrides.load_options(), diagnostics);
}

Reloads::~Reloads() {
  end();
}

void Reloads::end() {
  is_over_ = true;
  if (thread_.joinable()) thread_.join();
}

std::vector<Chapter> Reloads::before() const {
  std::vector<Chapter> chapters;
  const lang::Diagnostics* of_files = &first_;
  for (const auto& loaded : past_) {
    chapters.push_back({loaded->at, loaded->runner.get(), of_files});
    of_files = &loaded->diagnostics;
  }
  return chapters;
}

Reloads::Stamps Reloads::stamps() const {
  Stamps stamps;
  for (const std::string& file : files_) {
    std::error_code error;
    stamps.push_back(fs::last_write_time(file, error));
  }
  return stamps;
}

/// Editors write in pieces, or move a new file into the place of the old one. So files are loaded when they
/// have stayed unchanged from one look to the next.
void Reloads::watch() {
  Stamps known = stamps(), last = known;
  while (!is_over_) {
    std::this_thread::sleep_for(look_every);
    const Stamps now = stamps();
    if (now != known && now == last) {
      known = now;
      load();
    }
    last = now;
  }
}

/// The first file beside the task whose text has changed. The plant was built from the robot and scene files,
/// and from the task files of other robots. Empty: none has.
std::string Reloads::changed_beside_the_task() const {
  for (std::size_t i = 1; i < first_.sources().size(); ++i) {
    const lang::Source& source = first_.sources()[i];
    std::ifstream file(source.path, std::ios::binary);
    if (!file) continue;
    std::ostringstream bytes;
    bytes << file.rdbuf();
    std::string text = bytes.str();
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // as it was when it was read first
    if (text != source.text) return source.path;
  }
  return {};
}

void Reloads::tell_refusal(const std::string& why) const {
  print_error("zwang: " + arguments_.file + " was not reloaded, the old program goes on: " + why + "\n");
}

void Reloads::load() {
  if (const std::string other = changed_beside_the_task(); !other.empty())
    return tell_refusal(other + " has changed, which is read when a run starts: start it anew");
  auto next = std::make_unique<Loaded>();
  std::string refusal;
  try {
    next->program = cli::load(arguments_, next->diagnostics);
    print_error(rendered(next->diagnostics));
    const bool is_good = next->program && !next->diagnostics.has_errors();
    if (!is_good) {
      refusal = "it has errors";
    } else {
      next->runner = std::make_unique<runtime::Runner>(*next->program, settings_);
    }
  } catch (const std::exception& error) {
    refusal = error.what();
  }
  if (!refusal.empty()) return tell_refusal(refusal);
  const std::lock_guard lock(mutex_);
  loaded_ = std::move(next);
  is_loaded_ = true;
}

void Reloads::look(runtime::Runner& runner, double time) {
  std::this_thread::sleep_until(begin_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                             std::chrono::duration<double>(time)));
  if (!is_loaded_) return;
  std::unique_ptr<Loaded> next;
  {
    const std::lock_guard lock(mutex_);
    next = std::move(loaded_);
    is_loaded_ = false;
  }
  const bool is_over = runner.state() != runtime::RunState::running;
  if (is_over) return tell_refusal("the task is over");
  if (const runtime::SwapResult swap = runner.swap_program(*next->runner); !swap)
    return tell_refusal(runtime::describe(swap));
  const std::string name = "log-reload-" + std::to_string(past_.size() + 1);
  runtime::LogContext context = context_of(arguments_, next->diagnostics);
  context.facts["continues"] = last_log_;
  recorders_.push_back(record(arguments_, runner, *next->program, folder_, name, std::move(context)));
  last_log_ = name + ".mcap";
  logs_.push_back((folder_ / (name + ".mcap")).string());
  next->at = time;
  past_.push_back(std::move(next));
  print_error("zwang: " + arguments_.file + " reloaded at " + with_unit(time, "s") + "; " + last_log_ +
              " goes on\n");
}

}  // namespace zwang::cli
