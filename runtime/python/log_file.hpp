/// The log of a run, in a file that `zwang report` and `zwang replay` read.
#pragma once

#include <filesystem>

#include "read_program.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::python {

std::unique_ptr<runtime::LogSink> log_file(const std::filesystem::path& file, const ReadProgram& program,
                                           const runtime::Runner& runner);
/// Throws std::runtime_error where a closed log lacks a record.
void require_complete(const runtime::Recorder& recorder);

/// Writes each step of a runner into a file until it is closed. Runner and program outlive it.
class FileRecorder {
 public:
  FileRecorder(runtime::Runner& runner, const ReadProgram& program, const std::filesystem::path& file);
  ~FileRecorder() { stop(); }
  FileRecorder(const FileRecorder&) = delete;
  FileRecorder& operator=(const FileRecorder&) = delete;

  void wait() const { recorder_.wait_for_room(); }  ///< until the disk has room for a step
  void close();

 private:
  void stop() noexcept;

  runtime::Runner& runner_;
  runtime::Recorder recorder_;
};

}  // namespace zwang::python
