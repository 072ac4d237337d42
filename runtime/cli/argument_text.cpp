#include "argument_text.hpp"

#include <charconv>

#include "output.hpp"
#include "zwang/lang/quantity.hpp"

namespace zwang::cli {

double angle(const std::string& text) {
  const auto value = zwang::lang::read_angle(text);
  if (!value) throw Impossible("--start-yaw: `" + text + "` is not an angle; write it as `20 deg`");
  return *value;
}

std::array<double, 2> point(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto x = zwang::lang::read_length(text.substr(0, comma));
  const auto y = comma == std::string::npos ? std::nullopt : zwang::lang::read_length(text.substr(comma + 1));
  if (!x || !y) throw Impossible("--start-at: `" + text + "` is not a point; write it as `0 m, 0.5 m`");
  return {*x, *y};
}

std::uint64_t seed(const std::string& text) {
  // CLI11 would wrap a negative number around.
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Impossible("--seed: `" + text + "` is not a whole number from 0 to 2^64 - 1");
  }
  return value;
}

runtime::LogRotation rotation(const std::vector<std::string>& texts) {
  runtime::LogRotation rotation;
  for (const std::string& text : texts) {
    if (!runtime::read_rotation(text, rotation))
      throw Impossible("--log-rotate: `" + text +
                       "` is no size of at least 1 MB and no time of at least 1 s; write it as `500 MB` or "
                       "`10 min`");
  }
  return rotation;
}

std::map<std::string, std::string> parameters(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> values;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Impossible("-p: `" + text + "` does not set a parameter; write it as `name=20 N`");
    }
    const std::string name = text.substr(0, equals);
    if (!values.emplace(name, text.substr(equals + 1)).second)
      throw Impossible("-p: `" + name + "` is set twice; set it once");
  }
  return values;
}

}  // namespace zwang::cli
