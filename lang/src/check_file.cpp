#include "zwang/lang/check_file.hpp"

#include <optional>
#include <utility>

#include "zwang/lang/notes.hpp"
#include "zwang/lang/scene_for_robot.hpp"

namespace zwang::lang {

namespace {

template <typename Content>
FileContent content_of(std::optional<Content> content) {
  if (!content) return {};
  return *std::move(content);
}

/// A connection by itself, then with all that the task reads and its robot takes.
std::optional<Connection> connection_for(const std::optional<std::filesystem::path>& task,
                                         const std::filesystem::path& path, const LoadOptions& options,
                                         Diagnostics& diagnostics) {
  std::optional<Connection> connection = load_connection(path, diagnostics);
  if (!task) return connection;
  const std::optional<Program> program = load(*task, options, diagnostics);
  const bool is_good = connection && program && check_connection(*connection, *program, diagnostics);
  return is_good ? connection : std::nullopt;
}

}  // namespace

FileContent check_file(FileKind kind, const std::filesystem::path& path, const CheckOptions& options,
                       Diagnostics& diagnostics) {
  switch (kind) {
    case FileKind::robot:
      return content_of(load_robot(path, diagnostics));
    case FileKind::scene:
      return content_of(options.load.robot ? load_scene_for(*options.load.robot, path, diagnostics)
                                           : load_scene(path, diagnostics));
    case FileKind::scenario:
      return content_of(check_scenario(path, diagnostics));
    case FileKind::connection:
      return content_of(connection_for(options.task, path, options.load, diagnostics));
    case FileKind::study:
      return content_of(load_study(path, diagnostics));
    case FileKind::task:
      break;
  }
  return content_of(options.with_notes ? load_with_notes(path, options.load, diagnostics)
                                       : load(path, options.load, diagnostics));
}

}  // namespace zwang::lang
