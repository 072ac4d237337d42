// Which files are the log of a run.
#include "log/log_files.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {

namespace fs = std::filesystem;

std::string part_name(const std::string& stem, std::size_t part) {
  return stem + "_" + std::to_string(part) + ".mcap";
}

std::optional<std::size_t> part_of(const std::string& file, const std::string& stem) {
  constexpr std::string_view end = ".mcap";
  if (!file.starts_with(stem + "_") || !file.ends_with(end)) return std::nullopt;
  const std::string digits = file.substr(stem.size() + 1, file.size() - stem.size() - 1 - end.size());
  std::size_t part = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), part);
  // `log_007.mcap` is not ours.
  if (error != std::errc() || part_name(stem, part) != file) return std::nullopt;
  return part;
}

std::vector<fs::path> log_parts(const fs::path& folder, const std::string& stem) {
  std::vector<std::pair<std::size_t, fs::path>> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const auto part = part_of(entry.path().filename().string(), stem);
    if (part) found.emplace_back(*part, entry.path());
  }
  std::ranges::sort(found);
  std::vector<fs::path> parts;
  for (const auto& [part, path] : found) parts.push_back(path);
  return parts;
}

std::vector<fs::path> log_files(const fs::path& run) {
  std::error_code error;
  if (!fs::is_directory(run, error)) return {run};
  if (fs::exists(run / "log.mcap", error)) return {run / "log.mcap"};
  std::vector<fs::path> parts = log_parts(run, "log");
  if (parts.empty()) throw std::runtime_error(run.string() + ": holds no log.mcap");
  return parts;
}

}  // namespace zwang::runtime
