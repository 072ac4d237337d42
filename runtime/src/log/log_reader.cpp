#include "zwang/runtime/log_reader.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>

#include "log/block_code.hpp"
#include "log/compression.hpp"
#include "log/log_files.hpp"
#include "log/logged_columns.hpp"
#include "log/mcap_format.hpp"
#include "log/mcap_input.hpp"

namespace zwang::runtime {

namespace {

using mcap::Opcode;

std::map<std::string, std::string> facts_of(std::string_view bytes) {
  std::map<std::string, std::string> facts;
  mcap::Reader pairs(bytes);
  while (!pairs.rest().empty()) {
    const std::string key(pairs.text());
    const std::string value(pairs.text());
    if (!pairs.good()) break;
    facts[key] = value;
  }
  return facts;
}

}  // namespace

/// One file of a log. Its facts go into the contents; the facts of the files before it stay.
class LogRecords::File {
 public:
  File(const std::filesystem::path& path, LogContents& contents, bool is_first)
      : file_(path), contents_(contents), is_first_(is_first) {
    contents_.closed = file_.is_closed() && (is_first || contents.closed);
    if (!is_first) said_in_ = path.filename().string() + ": ";
  }

  /// Goes on to the next record; false where there is none any more.
  bool next() {
    while (true) {
      if (next_of_block() || next_message()) return true;
      if (!inside_.good()) lose(start_);
      inside_ = mcap::Reader(std::string_view{});
      if (is_over_ || file_.is_at_end()) break;
      start_ = file_.at();
      const std::optional<unsigned char> opcode = file_.next_record(content_);
      if (!opcode || !read_record(*opcode, content_)) {
        lose(start_);
      } else if (opcode == Opcode::data_end) {
        is_over_ = true;
      }
    }
    if (!file_.is_closed() && !is_end_told_) damaged(file_.size(), "the log ends here, and was not closed");
    is_end_told_ = true;
    return false;
  }

  double time() const { return time_; }
  std::span<const double> values() const { return values_; }

 private:
  void lose(std::uint64_t start) {
    damaged(start, "unreadable");
    if (!file_.go_to_next_chunk(start + 1)) is_over_ = true;
  }

  /// Of the block that was read last.
  bool next_of_block() {
    const std::size_t columns = contents_.columns.size();
    if (taken_ + columns > block_.size() || columns == 0) return false;
    values_ = std::span(block_).subspan(taken_, columns);
    taken_ += columns;
    note_record(values_.front());
    return true;
  }

  void note_record(double time) {
    if (contents_.records++ == 0) contents_.begin = time;
    contents_.end = time;
    time_ = time;
  }

  bool next_message() {
    while (inside_.good() && !inside_.rest().empty()) {
      const unsigned char opcode = inside_.opcode();
      const std::string_view record = inside_.raw(inside_.u64());
      if (inside_.good() && opcode == Opcode::message && read_message(record)) return true;
    }
    return false;
  }

  void damaged(std::uint64_t where, const std::string& what) {
    contents_.damage.push_back(said_in_ + "at byte " + std::to_string(where) + ": " + what);
  }

  /// False when the content is not what it should be, to the last byte: a record with a wrong length would
  /// swallow those behind it.
  bool read_record(unsigned char opcode, std::string_view content) {
    mcap::Reader fields(content);
    switch (opcode) {
      case Opcode::header:
        fields.text();
        fields.text();
        break;
      case Opcode::schema:
        read_schema(fields);
        break;
      case Opcode::channel:
        read_channel(fields);
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

  /// That of the records alone, which comes first: another number may have become theirs by a changed bit.
  void read_schema(mcap::Reader& fields) {
    const bool is_ours = fields.u16() == mcap::records_channel && !knows_schema_;
    fields.text();
    fields.text();
    const std::string_view schema = fields.text();
    if (!is_ours) return;
    knows_schema_ = true;
    if (is_first_) take_schema(schema);
  }

  void take_schema(std::string_view schema) {
    contents_.schema = schema;
    contents_.columns = logged_columns(contents_.schema);
  }

  void read_channel(mcap::Reader& fields) {
    const bool is_ours = fields.u16() == mcap::records_channel && !knows_channel_;
    fields.u16();
    fields.text();
    const std::string_view encoding = fields.text();
    fields.text();
    if (!is_ours) return;
    knows_channel_ = true;
    if (encoding == "json") json_.emplace(contents_.columns);
  }

  bool read_attachment(std::string_view content) {
    mcap::Reader fields(content);
    fields.u64();
    fields.u64();
    lang::Source source;
    source.path = fields.text();
    fields.text();
    source.text = fields.raw(fields.u64());
    const std::size_t before_crc = content.size() - fields.rest().size();
    const std::uint32_t crc = fields.u32();
    if (!fields.good() || !fields.rest().empty() || crc != crc32(content.substr(0, before_crc))) return false;
    if (is_first_) contents_.context.sources.push_back(std::move(source));
    return true;
  }

  bool read_chunk(std::string_view content) {
    mcap::Reader fields(content);
    fields.u64();
    fields.u64();
    const std::uint64_t size = fields.u64();
    const std::uint32_t crc = fields.u32();
    const std::string_view compression = fields.text();
    const std::string_view packed = fields.raw(fields.u64());
    if (!fields.good() || !fields.rest().empty() || size > mcap::largest_record || compression != "zstd")
      return false;
    if (!decompress(packed, static_cast<std::size_t>(size), chunk_) || crc32(chunk_) != crc) return false;
    inside_ = mcap::Reader(chunk_);
    return true;
  }

  /// Reports damage to the parts that have no CRC of their own: schema, facts, the index of a chunk.
  void judge_the_whole(std::uint32_t crc) {
    if (crc != 0 && crc != file_.data_crc() && contents_.damage.empty())
      contents_.damage.push_back(said_in_ + "a bit of it has changed, outside the records");
  }

  void read_metadata(mcap::Reader& fields) {
    const std::string_view name = fields.text();
    std::map<std::string, std::string> facts = facts_of(fields.text());
    if (name == mcap::end_name) {
      const std::string& text = facts[mcap::end_sequence];
      std::uint32_t sequence = next_sequence_;
      std::from_chars(text.data(), text.data() + text.size(), sequence);
      look_for_a_gap(sequence, "the end");
    }
    if (name == mcap::conclusion_name) contents_.conclusion = facts;
    if (name == mcap::facts_name && is_first_) contents_.context.facts = std::move(facts);
  }

  void look_for_a_gap(std::uint32_t sequence, const std::string& before) {
    if (sequence == next_sequence_) return;
    contents_.damage.push_back(said_in_ + std::to_string(sequence - next_sequence_) +
                               " records are missing before " + before);
  }

  /// False where it holds no record.
  bool read_message(std::string_view content) {
    mcap::Reader fields(content);
    if (fields.u16() != mcap::records_channel) return false;
    const std::uint32_t sequence = fields.u32();
    const double time = static_cast<double>(fields.u64()) * 1e-9;
    fields.u64();
    if (!fields.good()) return false;
    if (json_) {
      json_->read(fields.rest(), json_values_);
      values_ = json_values_;
      note_record(time);
    } else if (!begin_block(fields.rest())) {
      damaged(start_, "a block of records is unreadable");
      return false;
    }
    if (sequence != next_sequence_) look_for_a_gap(sequence, std::to_string(time) + " s");
    const std::size_t count = json_ ? 1 : block_.size() / contents_.columns.size();
    next_sequence_ = sequence + static_cast<std::uint32_t>(count);
    return json_ || next_of_block();
  }

  bool begin_block(std::string_view block) {
    taken_ = 0;
    const auto read = [&] { return read_block(block, contents_.columns.size(), block_); };
    if (read()) return true;
    if (is_first_ && !is_summary_read_) take_schema(file_.schema_of_summary());
    is_summary_read_ = true;
    if (read()) return true;
    block_.clear();
    return false;
  }

  mcap::Input file_;
  std::string content_;                      // of the record of the file that was read last
  std::uint64_t start_ = 0;                  // [bytes] where that record begins
  std::string chunk_;                        // its messages, unpacked
  mcap::Reader inside_{std::string_view{}};  // what is left of the chunk
  std::vector<double> block_;                // its records, unpacked
  std::size_t taken_ = 0;                    // numbers of `block_` that were given
  std::optional<JsonRecord> json_;           // where records are JSON
  std::vector<double> json_values_;
  double time_ = 0.0;  // [s] of the present record
  std::span<const double> values_;
  bool is_over_ = false, is_end_told_ = false;
  std::uint32_t next_sequence_ = 0;
  LogContents& contents_;
  bool is_first_;
  bool knows_schema_ = false, knows_channel_ = false, is_summary_read_ = false;
  std::string said_in_;  // before what is damaged in it
};

namespace {

/// Between two files of one log.
void note_missing_parts(const std::filesystem::path& before, const std::filesystem::path& next,
                        LogContents& contents) {
  const auto last = part_of(before.filename().string(), "log"),
             part = part_of(next.filename().string(), "log");
  if (!last || !part || *part == *last + 1) return;
  contents.damage.push_back(part_name("log", *last + 1) + " is missing");
}

}  // namespace

LogRecords::LogRecords(const std::filesystem::path& log) : files_(log_files(log)) {
  open_next();
}
LogRecords::~LogRecords() = default;

bool LogRecords::open_next() {
  while (opened_ < files_.size()) {
    const std::filesystem::path& path = files_[opened_++];
    if (opened_ > 1) note_missing_parts(files_[opened_ - 2], path, contents_);
    try {
      file_ = std::make_unique<File>(path, contents_, opened_ == 1);
      return true;
    } catch (const std::runtime_error& error) {
      if (opened_ == 1) throw;
      contents_.damage.emplace_back(error.what());
      contents_.closed = false;
    }
  }
  return false;
}

bool LogRecords::next() {
  while (!file_->next()) {
    if (!open_next()) return false;
  }
  return true;
}
double LogRecords::time() const {
  return file_->time();
}
std::span<const double> LogRecords::values() const {
  return file_->values();
}
const LogContents& LogRecords::contents() const {
  return contents_;
}

LogContents read_log(const std::filesystem::path& log,
                     const std::function<void(double time, std::span<const double> values)>& record,
                     const std::function<void(const LogContents& head)>& before) {
  LogRecords records(log);
  bool is_first = true;
  while (records.next()) {
    if (is_first && before) before(records.contents());
    is_first = false;
    record(records.time(), records.values());
  }
  return records.contents();
}

}  // namespace zwang::runtime
