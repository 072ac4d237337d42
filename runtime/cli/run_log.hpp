/// Where a run leaves its logs, and what they say of it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "verbs.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::cli {

using Recorders = std::vector<std::unique_ptr<runtime::Recorder>>;

/// A log's name for the text of the option `-p`, which is among its facts.
constexpr const char* from_command_line = "-p";

/// A folder of its own for the run: the given one, else the first free `runs/<task>-NNN`.
std::filesystem::path make_log_folder(const RunArguments& arguments);

/// The name of a log's first file.
std::string log_name(const RunArguments& arguments, const std::string& name);

/// Throws Impossible unless it is a log that can be read: an .mcap file, or a folder that holds one.
void require_log(const std::string& log);

/// The files that were read and everything that the command line changed: the same run again needs no more.
runtime::LogContext context_of(const RunArguments& arguments, const lang::Diagnostics& diagnostics);
/// Of one of the scene's robots: its task file alone says what it does.
runtime::LogContext context_of(const RunArguments& arguments, const lang::Scene& scene,
                               const lang::SceneRobot& robot, const lang::Diagnostics& diagnostics);

/// A log of `runner`, which runs `program`, in the folder, in the forms that the arguments ask for, and in
/// that of `also`. Its status tells what cannot be opened.
std::unique_ptr<runtime::Recorder> record(const RunArguments& arguments, runtime::Runner& runner,
                                          const lang::Program& program, const std::filesystem::path& folder,
                                          const std::string& name, runtime::LogContext context,
                                          std::unique_ptr<runtime::LogSink> also = nullptr);

}  // namespace zwang::cli
