#include <algorithm>
#include <cmath>

#include "log/compression.hpp"
#include "log/log_file.hpp"
#include "log/mcap_format.hpp"
#include "log/source_paths.hpp"
#include "log/tick_json.hpp"
#include "zwang/runtime/log_channels.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

namespace {

using mcap::Content;
using mcap::Opcode;

// A killed run loses at most one chunk and what is on the way to it: not more than 100 ms together.
constexpr std::uint64_t chunk_span = 50'000'000;          // [ns]
constexpr std::size_t chunk_room = std::size_t{1} << 20;  // [bytes]
// Where time stands still, because no samples arrive, its records have to be on disk all the same.
constexpr std::size_t chunk_records = 100;
constexpr std::uint16_t tick_id = mcap::tick_channel;  // of the schema, too; those of other channels follow

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
    const bool is_full =
        messages_in_chunk_ > 0 && (time_ >= chunk_begin_ + chunk_span ||
                                   messages_in_chunk_ >= chunk_records || chunk_.size() > chunk_room);
    if (is_full) error = append_chunk();
    add_message(ticks(), json_->of(values));
    if (more_)
      more_->take(values,
                  [this](std::size_t i, std::string_view json) { add_message(channels_[i + 1], json); });
    last_is_missing_ = false;
    return error;
  }

  std::string skip(std::uint64_t records) override {
    ticks().sequence += static_cast<std::uint32_t>(records);
    last_is_missing_ = true;
    return "";
  }

  std::string conclude(const std::map<std::string, std::string>& facts) override {
    if (more_ && messages_ > 0)
      more_->conclude(facts,
                      [this](std::size_t i, std::string_view json) { add_message(channels_[i + 1], json); });
    const std::string error = messages_in_chunk_ == 0 ? "" : append_chunk();
    return error.empty() ? append_metadata(mcap::conclusion_name, facts) : error;
  }

  std::string flush() override { return ""; }  // a chunk is on its way as soon as it is full

  std::string close() override {
    if (!file_.is_open()) return "";
    std::string error = messages_in_chunk_ == 0 ? "" : append_chunk();
    if (error.empty() && last_is_missing_)
      error = append_metadata(mcap::end_name, {{mcap::end_sequence, std::to_string(ticks().sequence)}});
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
    std::uint16_t id = tick_id;
    std::uint32_t sequence = 0;
    std::uint64_t messages = 0;
    std::vector<Stamp> in_chunk;
  };
  Channel& ticks() { return channels_.front(); }

  void open_channels(const std::vector<Column>& columns) {
    add_channel("/tick", "zwang.Tick", tick_schema(columns, context_.sources));
    if (!more_) return;
    more_->open(columns);
    for (const LogChannel& one : more_->channels()) add_channel(one.topic, one.schema, one.definition);
  }

  void add_channel(const std::string& topic, const std::string& schema, const std::string& definition) {
    Channel channel;
    channel.id = static_cast<std::uint16_t>(tick_id + channels_.size());
    schemas_and_channels_ += mcap::record(
        Opcode::schema, Content().u16(channel.id).text(schema).text("jsonschema").text(definition).bytes());
    schemas_and_channels_ += mcap::record(
        Opcode::channel, Content().u16(channel.id).u16(channel.id).text(topic).text("json").text("").bytes());
    channels_.push_back(channel);
  }

  /// A message of the present record.
  void add_message(Channel& channel, std::string_view json) {
    if (messages_in_chunk_++ == 0) chunk_begin_ = time_;
    channel.in_chunk.push_back({time_, chunk_.size()});
    Content content;
    content.u16(channel.id).u32(channel.sequence++).u64(time_).u64(time_).raw(json);
    chunk_ += mcap::record(Opcode::message, content.bytes());
    ++channel.messages;
    ++messages_;
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
    const std::optional<std::string> packed = compress(chunk_);
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
    Content content;
    content.u64(first).u64(last).u64(chunk_.size()).u32(crc32(chunk_)).text("zstd");
    content.u64(packed->size()).raw(*packed);
    begin_ = std::min(begin_, first);
    end_ = std::max(end_, last);
    ++chunks_;
    chunk_.clear();
    messages_in_chunk_ = 0;
    const std::string error = append(mcap::record(Opcode::chunk, content.bytes()) + index);
    return error.empty() ? file_.flush() : error;
  }

  std::string statistics() const {
    Content content;
    content.u64(messages_).u16(static_cast<std::uint16_t>(channels_.size()));
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
    constexpr std::string_view compression = "zstd";
    constexpr std::size_t fields = 8 + 8 + 8 + 4 + (4 + compression.size()) + 8;
    const std::string chunk = file_.read_at(place, mcap::record_head + fields);
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
  std::unique_ptr<TickJson> json_;
  std::string schemas_and_channels_, index_;  // of the summary
  std::size_t first_chunk_ = 0;               ///< [bytes] where it begins
  std::unique_ptr<LogChannels> more_;
  std::vector<Channel> channels_;  ///< the records', then the others in their order
  std::string chunk_;
  std::size_t messages_in_chunk_ = 0;
  std::uint64_t time_ = 0, chunk_begin_ = 0;  ///< [ns] of the present record; of the chunk's first one
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
