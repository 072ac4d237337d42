#include "zwang/runtime/log_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "log/compression.hpp"
#include "log/mcap_format.hpp"

namespace zwang::runtime {

namespace {

using mcap::Opcode;
using mcap::Reader;

constexpr std::uint64_t largest_record = std::uint64_t{64} << 20;  // [bytes]; ours are about 1 MiB at most
constexpr std::size_t search_window = std::size_t{1} << 20;        // [bytes]

std::map<std::string, std::string> facts_of(std::string_view bytes) {
  std::map<std::string, std::string> facts;
  Reader pairs(bytes);
  while (!pairs.rest().empty()) {
    const std::string key(pairs.text());
    const std::string value(pairs.text());
    if (!pairs.good()) break;
    facts[key] = value;
  }
  return facts;
}

}  // namespace

class LogRecords::Reading {
 public:
  explicit Reading(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    if (!file_) throw std::runtime_error(path.string() + ": " + std::strerror(errno));
    std::string magic(mcap::magic.size(), '\0');
    if (!take(magic) || magic != mcap::magic) throw std::runtime_error(path.string() + ": is no MCAP log");
    data_crc_ = crc32(magic);
    size_ = static_cast<std::uint64_t>(std::filesystem::file_size(path));
    contents_.closed = ends_with_magic();
  }

  /// Goes on to the next message; false where there is none any more.
  bool next() {
    while (true) {
      if (next_message()) return true;
      if (!inside_.good()) lose(start_);
      inside_ = Reader(std::string_view{});
      if (is_over_ || at_ >= size_) break;
      start_ = at_;
      const std::optional<unsigned char> opcode = next_record(content_);
      if (!opcode || !read_record(*opcode, content_)) {
        lose(start_);
      } else if (opcode == Opcode::data_end) {
        is_over_ = true;
      }
    }
    if (!contents_.closed && !is_end_told_) damaged(size_, "the log ends here, and was not closed");
    is_end_told_ = true;
    return false;
  }

  double time() const { return time_; }
  std::string_view json() const { return json_; }
  const LogContents& contents() const { return contents_; }

 private:
  void lose(std::uint64_t start) {
    damaged(start, "unreadable");
    if (!go_to_next_chunk(start + 1)) is_over_ = true;
  }

  bool next_message() {
    while (inside_.good() && !inside_.rest().empty()) {
      const unsigned char opcode = inside_.opcode();
      const std::string_view record = inside_.raw(inside_.u64());
      if (inside_.good() && opcode == Opcode::message && read_message(record)) return true;
    }
    return false;
  }

  bool take(std::string& bytes) {
    file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    at_ += static_cast<std::uint64_t>(file_.gcount());
    return static_cast<std::size_t>(file_.gcount()) == bytes.size();
  }

  void go_to(std::uint64_t place) {
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place));
    at_ = place;
  }

  bool ends_with_magic() {
    const std::uint64_t here = at_;
    std::string magic(mcap::magic.size(), '\0');
    if (size_ < here + magic.size()) return false;
    go_to(size_ - magic.size());
    const bool whole = take(magic) && magic == mcap::magic;
    go_to(here);
    return whole;
  }

  void damaged(std::uint64_t where, const std::string& what) {
    contents_.damage.push_back("at byte " + std::to_string(where) + ": " + what);
  }

  /// The opcode of the record that begins here, and its content; nothing when it cannot be one.
  std::optional<unsigned char> next_record(std::string& content) {
    std::string head(mcap::record_head, '\0');
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

  /// Whatever was damaged, chunks behind it can be found by how they begin.
  bool go_to_next_chunk(std::uint64_t from) {
    // opcode, length, two times, size and CRC stand before the name of the compression.
    constexpr std::size_t name_at = mcap::record_head + 8 + 8 + 8 + 4;
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

  /// False when the content is not what it should be, to the last byte: a record with a wrong length would
  /// swallow those behind it.
  bool read_record(unsigned char opcode, std::string_view content) {
    Reader fields(content);
    switch (opcode) {
      case Opcode::header:
        fields.text();
        fields.text();
        break;
      case Opcode::schema:
        read_schema(fields);
        break;
      case Opcode::channel:
        fields.u32();
        fields.text();
        fields.text();
        fields.text();
        break;
      case Opcode::message_index:
        fields.u16();
        fields.text();
        break;
      case Opcode::metadata:
        read_metadata(fields);
        break;
      case Opcode::data_end:
        judge_the_whole(fields.u32());
        break;
      case Opcode::attachment:
        return read_attachment(content);
      case Opcode::chunk:
        return read_chunk(content);
      default:
        return false;
    }
    return fields.good() && fields.rest().empty();
  }

  /// That of the records alone.
  void read_schema(Reader& fields) {
    const bool is_ours = fields.u16() == mcap::tick_channel;
    fields.text();
    fields.text();
    const std::string_view schema = fields.text();
    if (is_ours) contents_.schema = schema;
  }

  bool read_attachment(std::string_view content) {
    Reader fields(content);
    fields.u64();
    fields.u64();
    lang::Source source;
    source.path = fields.text();
    fields.text();
    source.text = fields.raw(fields.u64());
    const std::size_t before_crc = content.size() - fields.rest().size();
    const std::uint32_t crc = fields.u32();
    if (!fields.good() || !fields.rest().empty() || crc != crc32(content.substr(0, before_crc))) return false;
    contents_.context.sources.push_back(std::move(source));
    return true;
  }

  bool read_chunk(std::string_view content) {
    Reader fields(content);
    fields.u64();
    fields.u64();
    const std::uint64_t size = fields.u64();
    const std::uint32_t crc = fields.u32();
    const std::string_view compression = fields.text();
    const std::string_view packed = fields.raw(fields.u64());
    if (!fields.good() || !fields.rest().empty() || size > largest_record || compression != "zstd")
      return false;
    if (!decompress(packed, static_cast<std::size_t>(size), chunk_) || crc32(chunk_) != crc) return false;
    inside_ = Reader(chunk_);
    return true;
  }

  /// What is damaged and has no CRC of its own: schema, facts, the index of a chunk.
  void judge_the_whole(std::uint32_t crc) {
    if (crc != 0 && crc != data_crc_ && contents_.damage.empty())
      contents_.damage.emplace_back("a bit of it has changed, outside the records");
  }

  void read_metadata(Reader& fields) {
    const std::string_view name = fields.text();
    std::map<std::string, std::string> facts = facts_of(fields.text());
    if (name == mcap::end_name) {
      const std::string& text = facts[mcap::end_sequence];
      std::uint32_t sequence = next_sequence_;
      std::from_chars(text.data(), text.data() + text.size(), sequence);
      look_for_a_gap(sequence, "the end");
    }
    if (name == mcap::conclusion_name) contents_.conclusion = facts;
    if (name == mcap::facts_name) contents_.context.facts = std::move(facts);
  }

  void look_for_a_gap(std::uint32_t sequence, const std::string& before) {
    if (sequence == next_sequence_) return;
    contents_.damage.push_back(std::to_string(sequence - next_sequence_) + " records are missing before " +
                               before);
  }

  bool read_message(std::string_view content) {
    Reader fields(content);
    if (fields.u16() != mcap::tick_channel) return false;
    const std::uint32_t sequence = fields.u32();
    const double time = static_cast<double>(fields.u64()) * 1e-9;
    fields.u64();
    if (!fields.good()) return false;
    if (sequence != next_sequence_) look_for_a_gap(sequence, std::to_string(time) + " s");
    next_sequence_ = sequence + 1;
    if (contents_.records++ == 0) contents_.begin = time;
    contents_.end = time;
    time_ = time;
    json_ = fields.rest();
    return true;
  }

  std::ifstream file_;
  std::string content_;                // of the record of the file that was read last
  std::uint64_t start_ = 0;            // [bytes] where that record begins
  std::string chunk_;                  // its messages, unpacked
  Reader inside_{std::string_view{}};  // what is left of the chunk
  double time_ = 0.0;                  // [s] of the present message
  std::string_view json_;              // in `chunk_`
  bool is_over_ = false, is_end_told_ = false;
  std::uint64_t at_ = 0;    // [bytes] read so far
  std::uint64_t size_ = 0;  // [bytes] of the file
  std::uint32_t next_sequence_ = 0;
  std::uint32_t data_crc_ = 0;  // so far
  LogContents contents_;
};

LogRecords::LogRecords(const std::filesystem::path& path) : reading_(std::make_unique<Reading>(path)) {}
LogRecords::~LogRecords() = default;

bool LogRecords::next() {
  return reading_->next();
}
double LogRecords::time() const {
  return reading_->time();
}
std::string_view LogRecords::json() const {
  return reading_->json();
}
const LogContents& LogRecords::contents() const {
  return reading_->contents();
}

LogContents read_log(const std::filesystem::path& path,
                     const std::function<void(double time, std::string_view json)>& record,
                     const std::function<void(const LogContents& head)>& before) {
  LogRecords records(path);
  bool is_first = true;
  while (records.next()) {
    if (is_first && before) before(records.contents());
    is_first = false;
    record(records.time(), records.json());
  }
  return records.contents();
}

}  // namespace zwang::runtime
