/// The files that come with zwang: tasks that can be run by their names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace zwang::cli {

/// `specs` of the installation or of the checkout that the program was built in; nullopt when neither is
/// there.
std::optional<std::filesystem::path> shipped_folder();

/// `wall_align` is the shipped task of that name where no file is called so; in the folder `scenarios` of the
/// shipped files it is a scenario. Anything else stays as it is. Throws Impossible, with the name that was
/// meant, when a bare name is neither.
std::string file_or_shipped(const std::string& file, const std::string& folder = ".");

}  // namespace zwang::cli
