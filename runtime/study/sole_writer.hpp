#pragma once

#include <string>

namespace zwang::study {

/// The right to write a file of results. Two sweeps of one study would each run all of its cells, and
/// `--fresh` would delete what the other one writes. The right ends with the process, however that ends.
class SoleWriter {
 public:
  /// Makes the file where there is none. Throws std::runtime_error, with the reason, where it cannot be
  /// written, and where another process writes it.
  explicit SoleWriter(const std::string& path);
  ~SoleWriter();
  SoleWriter(const SoleWriter&) = delete;
  SoleWriter& operator=(const SoleWriter&) = delete;

  /// Deletes the results, and makes an empty file.
  void begin_anew();

 private:
  void take();

  std::string path_;
  int file_ = -1;
};

}  // namespace zwang::study
