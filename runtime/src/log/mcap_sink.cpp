#include <algorithm>
#include <cmath>

#include "log/block_code.hpp"
#include "log/compression.hpp"
#include "log/log_file.hpp"
#include "log/mcap_format.hpp"
#include "log/pace.hpp"
#include "log/source_paths.hpp"
#include "log/tick_json.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

namespace {

using mcap::Content;
using mcap::Opcode;

// A killed run loses at most one chunk and what is on the way to it: not more than 100 ms together.
constexpr std::uint64_t chunk_span = 75'000'000;          // [ns]
constexpr std::size_t chunk_room = std::size_t{1} << 20;  // [bytes]
// Where time stands still, because no samples arrive, its records have to be on disk all the same.
constexpr std::size_t chunk_records = 100;
constexpr std::string_view compression = "zstd";
constexpr std::size_t chunk_fields =
    8 + 8 + 8 + 4 + (4 + compression.size()) + 8;            // [bytes] before its messages
constexpr std::uint16_t records_id = mcap::records_channel;  // of the schema, too; other channels follow
constexpr double shown_every = 0.1;                          // [s]: a record in the form that viewers read

std::uint64_t nanoseconds(double seconds) {
  return seconds > 0.0 ? static_cast<std::uint64_t>(std::llround(seconds * 1e9)) : 0;
}

std::string media_type(const std::string& path) {
  return path.ends_with(".urdf") ? "application/xml" : "application/yaml";
}

std::string map_of(const std::map<std::string, std::string>& facts) {
  Content pairs;
  for (const auto& [key, value] : facts) pairs.text(key).text(value);
  return pairs.bytes();
}

/// The parts of the file follow one another as in the specification: header, data (schema, channel, facts,
/// attachments, chunks), summary, footer.
class McapSink : public LogSink {
 public:
  McapSink(const std::filesystem::path& path, LogContext context, std::unique_ptr<LogChannels> more)
      : file_(path), context_(with_paths_from_one_folder(std::move(context))), more_(std::move(more)) {}

  std::string open(const std::vector<Column>& columns) override {
    block_ = std::make_unique<BlockWriter>(columns.size());
    json_ = std::make_unique<TickJson>(columns);
    std::string error = file_.open();
    if (!error.empty()) return error;
    open_channels(columns);
    error = append(std::string(mcap::magic) +
                   mcap::record(Opcode::header, Content().text("").text("zwang").bytes()) +
                   schemas_and_channels_);
    if (error.empty()) error = append_metadata(mcap::facts_name, context_.facts);
    for (const lang::Source& source : context_.sources) {
      if (error.empty()) error = append_attachment(source);
    }
    first_chunk_ = file_.size();
    return error.empty() ? file_.flush() : error;
  }

  std::string write(std::span<const double> values) override {
    time_ = nanoseconds(values.front());
    std::string error;
    const bool is_full = has_chunk_ && (time_ >= chunk_begin_ + chunk_span ||
                                        block_->records() >= chunk_records || chunk_.size() > chunk_room);
    if (is_full) error = append_chunk();
    begin_chunk();
    if (block_->records() == 0) block_begin_ = time_;
    block_->add(values.data());
    if (shown_.is_due(values.front())) add_message(channels_[shown], time_, json_->of(values));
    if (more_) more_->take(values, put_);
    last_is_missing_ = false;
    return error;
  }

  /// A block has no gap: its records are counted from the first one.
  std::string skip(std::uint64_t records) override {
    const std::string error = block_->records() == 0 ? "" : append_chunk();
    channels_[all].sequence += static_cast<std::uint32_t>(records);
    last_is_missing_ = true;
    return error;
  }

  std::string conclude(const std::map<std::string, std::string>& facts) override {
    if (more_ && (messages_ > 0 || has_chunk_)) more_->conclude(facts, put_);
    const std::string error = has_chunk_ ? append_chunk() : "";
    return error.empty() ? append_metadata(mcap::conclusion_name, facts) : error;
  }

  std::uint64_t size() const override { return file_.size(); }
  std::string flush() override { return ""; }  // a chunk is on its way as soon as it is full

  std::string close() override {
    if (!file_.is_open()) return "";
    std::string error = has_chunk_ ? append_chunk() : "";
    if (error.empty() && last_is_missing_)
      error =
          append_metadata(mcap::end_name, {{mcap::end_sequence, std::to_string(channels_[all].sequence)}});
    // Chunks and attachments have CRCs of their own; schema, facts and the index of each chunk have this one.
    if (error.empty()) error = append(mcap::record(Opcode::data_end, Content().u32(data_crc_).bytes()));
    if (error.empty()) error = append_summary();
    const std::string closing = file_.close();
    return error.empty() ? closing : error;
  }

 private:
  struct Stamp {
    std::uint64_t time = 0;    ///< [ns]
    std::uint64_t offset = 0;  ///< [bytes] in the chunk
  };

  std::string append(std::string_view bytes) {
    data_crc_ = crc32(bytes, data_crc_);
    return file_.append(bytes);
  }

  struct Channel {
    std::uint16_t id = records_id;
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
    std::vector<Stamp> in_chunk;
  };
  /// Two channels share the schema of the records: all of them in blocks, and some of them as JSON.
  enum Own : std::size_t { all, shown, others };

  void open_channels(const std::vector<Column>& columns) {
    add_schema(records_id, "zwang.Tick", tick_schema(columns, context_.sources));
    add_channel("/records", records_id, block_encoding);
    add_channel("/tick", records_id, "json");
    if (!more_) return;
    more_->open(columns);
    for (const LogChannel& one : more_->channels()) {
      const auto schema = static_cast<std::uint16_t>(records_id + channels_.size());
      add_schema(schema, one.schema, one.definition);
      add_channel(one.topic, schema, "json");
    }
  }

  void add_schema(std::uint16_t id, const std::string& name, const std::string& definition) {
    schemas_and_channels_ += mcap::record(
        Opcode::schema, Content().u16(id).text(name).text("jsonschema").text(definition).bytes());
    ++schemas_;
  }

  void add_channel(const std::string& topic, std::uint16_t schema, const std::string& encoding) {
    Channel channel;
    channel.id = static_cast<std::uint16_t>(records_id + channels_.size());
    schemas_and_channels_ += mcap::record(
        Opcode::channel, Content().u16(channel.id).u16(schema).text(topic).text(encoding).text("").bytes());
    channels_.push_back(channel);
  }

  void begin_chunk() {
    if (!has_chunk_) chunk_begin_ = time_;
    has_chunk_ = true;
  }

  void add_message(Channel& channel, std::uint64_t time, std::string_view message) {
    begin_chunk();
    channel.in_chunk.push_back({time, chunk_.size()});
    constexpr std::size_t fields = 2 + 4 + 8 + 8;
    Content head;
    head.raw(std::string(1, static_cast<char>(Opcode::message))).u64(fields + message.size());
    head.u16(channel.id).u32(channel.sequence++).u64(time).u64(time);
    chunk_.append(head.bytes()).append(message);
    ++channel.messages;
    ++messages_;
  }

  /// One message, stamped with the time of its first record.
  void add_block() {
    const std::size_t records = block_->records();
    if (records == 0) return;
    add_message(channels_[all], block_begin_, block_->take());
    channels_[all].sequence += static_cast<std::uint32_t>(records - 1);
  }

  std::string append_metadata(std::string_view name, const std::map<std::string, std::string>& facts) {
    const std::string whole =
        mcap::record(Opcode::metadata, Content().text(name).text(map_of(facts)).bytes());
    index_ += mcap::record(Opcode::metadata_index,
                           Content().u64(file_.size()).u64(whole.size()).text(name).bytes());
    ++metadata_;
    return append(whole);
  }

  std::string append_attachment(const lang::Source& source) {
    const std::string type = media_type(source.path);
    Content content;
    content.u64(0).u64(0).text(source.path).text(type).u64(source.text.size()).raw(source.text);
    content.u32(crc32(content.bytes()));
    const std::string whole = mcap::record(Opcode::attachment, content.bytes());
    index_ += mcap::record(Opcode::attachment_index, Content()
                                                         .u64(file_.size())
                                                         .u64(whole.size())
                                                         .u64(0)
                                                         .u64(0)
                                                         .u64(source.text.size())
                                                         .text(source.path)
                                                         .text(type)
                                                         .bytes());
    return append(whole);
  }

  std::string append_chunk() {
    add_block();
    const std::optional<std::string_view> packed = compressor_.compress(chunk_);
    if (!packed) return "the log could not be compressed";
    std::uint64_t first = ~std::uint64_t{0}, last = 0;
    std::string index;
    for (Channel& channel : channels_) {
      if (channel.in_chunk.empty()) continue;
      Content stamps;
      for (const Stamp& stamp : channel.in_chunk) {
        stamps.u64(stamp.time).u64(stamp.offset);
        first = std::min(first, stamp.time);
        last = std::max(last, stamp.time);
      }
      index += mcap::record(Opcode::message_index, Content().u16(channel.id).text(stamps.bytes()).bytes());
      channel.in_chunk.clear();
    }
    // Head, messages and index follow each other into the file: no copy of a chunk is made.
    Content head;
    head.raw(std::string(1, static_cast<char>(Opcode::chunk))).u64(chunk_fields + packed->size());
    head.u64(first).u64(last).u64(chunk_.size()).u32(crc32(chunk_)).text(compression).u64(packed->size());
    begin_ = std::min(begin_, first);
    end_ = std::max(end_, last);
    ++chunks_;
    chunk_.clear();
    has_chunk_ = false;
    std::string error = append(head.bytes());
    for (const std::string_view part : {*packed, std::string_view(index)}) {
      if (error.empty()) error = append(part);
    }
    return error.empty() ? file_.flush() : error;
  }

  std::string statistics() const {
    Content content;
    content.u64(messages_).u16(schemas_);
    content.u32(static_cast<std::uint32_t>(channels_.size()));
    content.u32(static_cast<std::uint32_t>(context_.sources.size()))
        .u32(metadata_)
        .u32(chunks_)
        .u64(messages_ > 0 ? begin_ : 0)
        .u64(end_);
    Content counts;
    for (const Channel& channel : channels_) counts.u16(channel.id).u64(channel.messages);
    content.text(counts.bytes());
    return mcap::record(Opcode::statistics, content.bytes());
  }

  /// The index of the chunk that begins at `place`, and where the record behind it begins. Empty where none
  /// does.
  std::string chunk_index_at(std::size_t place, std::size_t& next) const {
    const std::string chunk = file_.read_at(place, mcap::record_head + chunk_fields);
    mcap::Reader head(chunk);
    const unsigned char opcode = head.opcode();
    const std::size_t size = mcap::record_head + static_cast<std::size_t>(head.u64());
    next = place + size;
    if (opcode != Opcode::chunk) return "";
    const std::uint64_t first = head.u64(), last = head.u64(), unpacked = head.u64();
    head.u32();
    head.text();
    const std::uint64_t packed = head.u64();
    if (!head.good()) return "";
    Content offsets;
    const std::size_t begin = next;
    while (true) {
      const std::string of_messages = file_.read_at(next, mcap::record_head + sizeof(std::uint16_t));
      mcap::Reader index(of_messages);
      const unsigned char kind = index.opcode();
      const std::uint64_t index_size = mcap::record_head + index.u64();
      const std::uint16_t channel = index.u16();
      if (!index.good() || kind != Opcode::message_index) break;
      offsets.u16(channel).u64(next);
      next += static_cast<std::size_t>(index_size);
    }
    Content content;
    content.u64(first).u64(last).u64(place).u64(size).text(offsets.bytes());
    content.u64(next - begin).text(compression).u64(packed).u64(unpacked);
    return mcap::record(Opcode::chunk_index, content.bytes());
  }

  /// The summary, and the footer with the CRC of the summary and of its own fields before the CRC. The chunks
  /// are read back for it: an index of 20 chunks a second, kept in memory, would grow for as long as a run.
  std::string append_summary() {
    const std::size_t begin = file_.size();
    std::string error = file_.flush();
    std::uint32_t crc = crc32("");
    const auto put = [&](std::string_view bytes) {
      crc = crc32(bytes, crc);
      if (error.empty()) error = file_.append(bytes);
    };
    put(schemas_and_channels_ + statistics());
    for (std::size_t place = first_chunk_, next = 0; place < begin && error.empty(); place = next) {
      put(chunk_index_at(place, next));
      if (next <= place) break;
    }
    put(index_);
    Content content;
    content.u64(begin).u64(0);
    Content head;  // of the footer's record, whose length is known
    head.raw(std::string(1, static_cast<char>(Opcode::footer))).u64(content.bytes().size() + 4);
    crc = crc32(head.bytes() + content.bytes(), crc);
    content.u32(crc);
    const std::string footer = mcap::record(Opcode::footer, content.bytes()) + std::string(mcap::magic);
    return error.empty() ? file_.append(footer) : error;
  }

  LogFile file_;
  LogContext context_;
  std::unique_ptr<BlockWriter> block_;
  std::unique_ptr<TickJson> json_;
  Pace shown_{shown_every};
  Compressor compressor_;
  std::string schemas_and_channels_, index_;  // of the summary
  std::size_t first_chunk_ = 0;               ///< [bytes] where it begins
  std::unique_ptr<LogChannels> more_;
  std::vector<Channel> channels_;  ///< as `Own`, then the others in their order
  std::uint16_t schemas_ = 0;
  LogChannels::Put put_ = [this](std::size_t i, std::string_view json) {
    add_message(channels_[others + i], time_, json);
  };
  std::string chunk_;  ///< messages, without the block that is open
  bool has_chunk_ = false;
  std::uint64_t time_ = 0, chunk_begin_ = 0;  ///< [ns] of the present record; of the chunk's first one
  std::uint64_t block_begin_ = 0;             ///< [ns]
  std::uint32_t data_crc_ = 0;
  std::uint32_t chunks_ = 0, metadata_ = 0;
  std::uint64_t messages_ = 0;
  bool last_is_missing_ = false;  ///< records behind the last message were dropped
  std::uint64_t begin_ = ~std::uint64_t{0}, end_ = 0;
};

}  // namespace

std::unique_ptr<LogSink> mcap_sink(const std::filesystem::path& path, LogContext context) {
  return mcap_sink(path, std::move(context), nullptr);
}

std::unique_ptr<LogSink> mcap_sink(const std::filesystem::path& path, LogContext context,
                                   std::unique_ptr<LogChannels> channels) {
  return std::make_unique<McapSink>(path, std::move(context), std::move(channels));
}

}  // namespace zwang::runtime
