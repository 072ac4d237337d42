#include "log/mcap_input.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "log/compression.hpp"
#include "log/mcap_format.hpp"

namespace zwang::runtime::mcap {

namespace {

constexpr std::size_t search_window = std::size_t{1} << 20;  // [bytes]

}  // namespace

Input::Input(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  if (!file_) throw std::runtime_error(path.string() + ": " + std::strerror(errno));
  std::string begin(magic.size(), '\0');
  if (!take(begin) || begin != magic) throw std::runtime_error(path.string() + ": is no MCAP log");
  data_crc_ = crc32(begin);
  size_ = static_cast<std::uint64_t>(std::filesystem::file_size(path));
  is_closed_ = ends_with_magic();
}

bool Input::take(std::string& bytes) {
  file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  at_ += static_cast<std::uint64_t>(file_.gcount());
  return static_cast<std::size_t>(file_.gcount()) == bytes.size();
}

void Input::go_to(std::uint64_t place) {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(place));
  at_ = place;
}

bool Input::ends_with_magic() {
  const std::uint64_t here = at_;
  std::string end(magic.size(), '\0');
  if (size_ < here + end.size()) return false;
  go_to(size_ - end.size());
  const bool whole = take(end) && end == magic;
  go_to(here);
  return whole;
}

std::optional<unsigned char> Input::next_record(std::string& content) {
  std::string head(record_head, '\0');
  if (!take(head)) return std::nullopt;
  Reader fields(head);
  const unsigned char opcode = fields.opcode();
  const std::uint64_t length = fields.u64();
  if (opcode == 0 || opcode > Opcode::data_end || length > size_ - at_ || length > largest_record) {
    return std::nullopt;
  }
  content.resize(static_cast<std::size_t>(length));
  if (!take(content)) return std::nullopt;
  if (opcode != Opcode::data_end) data_crc_ = crc32(content, crc32(head, data_crc_));
  return opcode;
}

bool Input::go_to_next_chunk(std::uint64_t from) {
  // opcode, length, two times, size and CRC stand before the name of the compression.
  constexpr std::size_t name_at = record_head + 8 + 8 + 8 + 4;
  constexpr std::string_view name("\4\0\0\0zstd", 8);
  std::string window;
  for (std::uint64_t place = from; place + name_at + name.size() <= size_;) {
    go_to(place);
    window.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size_ - place, search_window)));
    if (!take(window)) return false;
    for (std::size_t i = window.find(name); i != std::string::npos; i = window.find(name, i + 1)) {
      if (i >= name_at && window[i - name_at] == static_cast<char>(Opcode::chunk)) {
        go_to(place + i - name_at);
        return true;
      }
    }
    if (window.size() < search_window) return false;
    place += search_window - name_at - name.size();
  }
  return false;
}

/// Of the record that begins here; empty where it is another one.
std::string Input::content_of(unsigned char opcode) {
  std::string head(record_head, '\0'), content;
  if (!take(head)) return "";
  Reader fields(head);
  const bool is_one = fields.opcode() == opcode;
  const std::uint64_t length = fields.u64();
  if (!is_one || length > size_ - at_ || length > largest_record) return "";
  content.resize(static_cast<std::size_t>(length));
  return take(content) ? content : "";
}

std::string Input::schema_of_summary() {
  constexpr std::size_t footer_size = record_head + 8 + 8 + 4;
  if (!is_closed_ || size_ < footer_size + magic.size()) return "";
  const std::uint64_t here = at_;
  go_to(size_ - footer_size - magic.size());
  const std::string end = content_of(Opcode::footer);
  const std::uint64_t summary = Reader(end).u64();
  std::string text;
  if (summary < size_) {
    go_to(summary);
    const std::string schema = content_of(Opcode::schema);
    Reader fields(schema);
    fields.u16();
    fields.text();
    fields.text();
    text = fields.text();
  }
  go_to(here);
  return text;
}

}  // namespace zwang::runtime::mcap
