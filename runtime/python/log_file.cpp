#include "log_file.hpp"

#include <stdexcept>

#include "zwang/runtime/log_channels.hpp"

namespace zwang::python {

namespace {

std::vector<std::unique_ptr<runtime::LogSink>> alone(std::unique_ptr<runtime::LogSink> sink) {
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(std::move(sink));
  return sinks;
}

}  // namespace

std::unique_ptr<runtime::LogSink> log_file(const std::filesystem::path& file, const ReadProgram& program,
                                           const runtime::Runner& runner) {
  runtime::LogContext context;
  context.sources = program.sources;
  context.facts = runner.facts();
  context.facts.insert(program.facts.begin(), program.facts.end());
  return runtime::program_log(file, {}, context, program);
}

void require_complete(const runtime::Recorder& recorder) {
  const runtime::RecorderStatus status = recorder.status();
  if (status.complete()) return;
  throw std::runtime_error(
      "the log is incomplete: " +
      (status.error.empty() ? std::to_string(status.dropped) + " records were dropped" : status.error));
}

FileRecorder::FileRecorder(runtime::Runner& runner, const ReadProgram& program,
                           const std::filesystem::path& file)
    : runner_(runner), recorder_(alone(log_file(file, program, runner)), runner.columns()) {
  runner_.record_to(&recorder_);
}

void FileRecorder::stop() noexcept {
  runner_.record_to(nullptr);
  recorder_.close();
}

void FileRecorder::close() {
  stop();
  require_complete(recorder_);
}

}  // namespace zwang::python
