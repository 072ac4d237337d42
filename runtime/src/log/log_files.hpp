/// The names of a log's files: `log.mcap`, or `log_0.mcap`, `log_1.mcap` and so on, as rosbag2 splits a bag.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zwang::runtime {

std::string part_name(const std::string& stem, std::size_t part);
/// Which one the file of this name is; none: it is no part of that log.
std::optional<std::size_t> part_of(const std::string& file, const std::string& stem);
/// The parts that are in the folder, in their order.
std::vector<std::filesystem::path> log_parts(const std::filesystem::path& folder, const std::string& stem);

}  // namespace zwang::runtime
