/// The records of a run as the messages of its live page.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "zwang/runtime/recorder.hpp"

namespace zwang::cli {

/// The JSON, padded with spaces to whole words of four bytes and preceded by its length, then the numbers,
/// all little-endian.
std::string live_message(std::string json, const std::vector<float>& numbers);

/// Puts `bucket` [s] of records into one message: of each column its least and its largest value, in the
/// order in which they came, then all last values. Task changes and events are told by name. Called by the
/// recorder's thread; `send` must not wait.
std::unique_ptr<runtime::LogSink> live_sink(double bucket, std::function<void(std::string)> send);

}  // namespace zwang::cli
