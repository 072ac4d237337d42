#include "report_page.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "output.hpp"
#include "shipped.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view place_of_data = "zwang-data-goes-here";

}  // namespace

std::optional<fs::path> page_parts_file() {
  return beside_program({"../share/zwang/web/report.html", "../../web/dist/report.html"});
}

std::string page_parts() {
  if (const auto path = page_parts_file()) {
    std::ifstream file(*path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    if (file) return bytes.str();
  }
  throw Impossible(
      "the parts of the page are missing; in a checkout `./dev web` builds them, from packages of npm, and "
      "`cmake --install` takes them along");
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[three >> (6 * (3 - k)) & 63U] : '=';
  }
  return text;
}

std::string page_with(std::string parts, const std::string& json) {
  const std::size_t at = parts.find(place_of_data);
  if (at == std::string::npos) throw Impossible("the parts of the page are of another version of zwang");
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) c == '<' ? safe += "\\u003c" : safe += c;
  return parts.replace(at, place_of_data.size(), safe);
}

}  // namespace zwang::cli
