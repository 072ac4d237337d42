/// The page of a run: the parts that `./dev web` builds, and the run's data in their midst.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace zwang::cli {

/// The page without data. It lies beside the installed program, or in the checkout that the program was built
/// in. Throws Impossible, with the way out, where it is missing.
std::string page_parts();

/// The file that they are in, where it is there.
std::optional<std::filesystem::path> page_parts_file();

/// The page with the data in it, which are JSON of ASCII letters: nothing of them can end the element that
/// they stand in.
std::string page_with(std::string parts, const std::string& json);

/// Makes the page of the run in this folder, or of this .mcap; where no file is named, report.html beside the
/// log. The path of the page. Throws Impossible.
std::string write_page(const std::string& run, const std::optional<std::string>& out);

/// Makes the page that compares two runs; where no file is named, compare.html beside the first one's log.
/// The path of the page. Throws Impossible.
std::string write_comparison(const std::string& run, const std::string& other,
                             const std::optional<std::string>& out);

std::string base64(const std::string& bytes);

}  // namespace zwang::cli
