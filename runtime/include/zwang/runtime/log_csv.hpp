/// A log as CSV, for programs that read nothing else.
#pragma once

#include <functional>
#include <string_view>

#include "zwang/export.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {

/// The text that `csv_sink` would have written, piece by piece into `put`: a line a record, `name [unit]` in
/// the header, numbers with nine significant digits. Throws as LogRecords; the contents tell of damage.
ZWANG_EXPORT LogContents log_as_csv(const std::filesystem::path& log,
                                    const std::function<void(std::string_view)>& put);

}  // namespace zwang::runtime
