#include "dds.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "message.hpp"
#include "work_queue.hpp"

namespace zwang::connect {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t usual_payload = 4096;  // larger ones make their room larger
constexpr int input_depth = 10;
const eprosima::fastrtps::Duration_t longest_write(0, 1'000'000);  // 1 ms

/// A payload passes as it is: encoding is message.cpp's.
class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = usual_payload;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const std::span<const std::uint8_t>*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<const std::span<const std::uint8_t>*>(data)->size();
    return [size] { return static_cast<std::uint32_t>(size); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

/// Which processes run on this machine, by the addresses that they name when they are discovered.
class Neighbours : public dds::DomainParticipantListener {
 public:
  explicit Neighbours(bool admits_all) : admits_all_(admits_all) {}

  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) override {
    using Info = rtps::ParticipantDiscoveryInfo;
    const std::lock_guard lock(mutex_);
    const rtps::GuidPrefix_t& process = info.info.m_guid.guidPrefix;
    const bool is_gone = info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT;
    std::erase(here_, process);
    if (is_gone) return;
    std::vector<Address> named;
    for (const auto& locator : info.info.default_locators.unicast) {
      Address address{};
      std::copy_n(locator.address + 12, address.size(), address.begin());
      named.push_back(address);
    }
    if (is_of_this_machine(named, own_addresses())) here_.push_back(process);
  }

  bool admits(const rtps::GuidPrefix_t& process) {
    if (admits_all_) return true;
    const std::lock_guard lock(mutex_);
    const bool is_here = std::find(here_.begin(), here_.end(), process) != here_.end();
    if (!is_here) ++foreign;
    return is_here;
  }

  std::atomic<std::uint64_t> foreign{0};

 private:
  bool admits_all_;
  std::mutex mutex_;
  std::vector<rtps::GuidPrefix_t> here_;
};

Sender sender_of(const rtps::GUID_t& guid) {
  Sender sender{};
  std::copy_n(guid.guidPrefix.value, 12, sender.begin());
  std::copy_n(guid.entityId.value, 4, sender.begin() + 12);
  return sender;
}

class Listener : public dds::DataReaderListener {
 public:
  Listener(std::function<void(const Payload&)> on_payload, Neighbours& neighbours)
      : on_payload_(std::move(on_payload)), neighbours_(neighbours) {}
  void on_data_available(dds::DataReader* reader) override {
    // Peers may be served by different threads of the transport.
    const std::lock_guard lock(mutex_);
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes_, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      const rtps::GUID_t& writer = info.sample_identity.writer_guid();
      if (info.valid_data && neighbours_.admits(writer.guidPrefix)) on_payload_({bytes_, sender_of(writer)});
    }
  }

 private:
  std::function<void(const Payload&)> on_payload_;
  Neighbours& neighbours_;
  std::mutex mutex_;
  Bytes bytes_;
};

class CountingListener : public dds::DataWriterListener {
 public:
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    readers = status.current_count;
  }
  std::atomic<int> readers{0};
};

template <typename Qos>
void set_up(Qos& qos, dds::ReliabilityQosPolicyKind kind, int depth) {
  qos.reliability().kind = kind;
  qos.history().depth = depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
}

class DdsWriter : public Writer {
 public:
  DdsWriter(const DdsWriter&) = delete;
  DdsWriter& operator=(const DdsWriter&) = delete;
  // DDS must not call a listener that is gone.
  ~DdsWriter() override {
    if (writer_ != nullptr) publisher_.delete_datawriter(writer_);
  }
  DdsWriter(dds::Publisher& publisher, dds::Topic& topic, bool keeps_last) : publisher_(publisher) {
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    set_up(qos, dds::RELIABLE_RELIABILITY_QOS, 1);  // only the latest command counts
    qos.reliability().max_blocking_time = longest_write;
    if (keeps_last) qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    writer_ = publisher.create_datawriter(&topic, qos, &listener_);
    if (writer_ == nullptr) throw std::runtime_error("DDS gives no writer for " + topic.get_name());
  }
  bool write(std::span<const std::uint8_t> payload) noexcept override {
    try {
      return writer_->write(&payload);
    } catch (...) {
      return false;
    }
  }
  int readers() const noexcept override { return listener_.readers; }

 private:
  dds::Publisher& publisher_;
  CountingListener listener_;
  dds::DataWriter* writer_ = nullptr;
};

/// The processes whose readers have found a writer.
class MatchListener : public dds::DataWriterListener {
 public:
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    const rtps::GUID_t reader = rtps::iHandle2GUID(status.last_subscription_handle);
    {
      const std::lock_guard lock(mutex_);
      std::erase(readers_, reader);
      if (status.current_count_change > 0) readers_.push_back(reader);
    }
    changed_.notify_all();
  }
  /// Waits until a reader of the process is there; for so long at most.
  void wait_for(const rtps::GuidPrefix_t& process, std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [&] {
      return std::any_of(readers_.begin(), readers_.end(),
                         [&](const rtps::GUID_t& reader) { return reader.guidPrefix == process; });
    });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<rtps::GUID_t> readers_;
};

/// Threads of DDS queue requests, and a thread of its own handles and answers them. A reply may wait until
/// its reader is found, and threads of DDS also bring the robot's samples.
class Service : public dds::DataReaderListener {
 public:
  Service(Handler handler, Neighbours& neighbours)
      : handler_(std::move(handler)), neighbours_(neighbours), queue_(std::make_shared<WorkQueue<Item>>()) {}
  ~Service() override { stop(); }

  void start(dds::Publisher& publisher, dds::Subscriber& subscriber, dds::Topic& request, dds::Topic& reply) {
    dds::DataWriterQos writing = dds::DATAWRITER_QOS_DEFAULT;
    set_up(writing, dds::RELIABLE_RELIABILITY_QOS, input_depth);
    writer_ = publisher.create_datawriter(&reply, writing, &matches_);
    thread_ = std::thread([this] { serve(); });
    dds::DataReaderQos reading = dds::DATAREADER_QOS_DEFAULT;
    set_up(reading, dds::RELIABLE_RELIABILITY_QOS, input_depth);
    const bool is_good =
        writer_ != nullptr && subscriber.create_datareader(&request, reading, this) != nullptr;
    if (!is_good) throw std::runtime_error("DDS gives no service " + request.get_name());
  }
  void stop() {
    queue_->end();
    if (thread_.joinable()) thread_.join();
  }

  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      const rtps::GUID_t& client = info.sample_identity.writer_guid();
      if (!info.valid_data || !neighbours_.admits(client.guidPrefix)) continue;
      auto call = take_apart(bytes, sender_of(client));
      if (!call) continue;
      Request request{std::move(*call), client.guidPrefix, info.sample_identity};
      // rmw_fastrtps names the reader of the reply here.
      const rtps::GUID_t& reply_reader = info.related_sample_identity.writer_guid();
      if (reply_reader != rtps::GUID_t::unknown()) request.identity.writer_guid() = reply_reader;
      queue_->put({std::move(request), {}}, most_requests);
    }
  }

 private:
  struct Request {
    ServiceCall call;
    rtps::GuidPrefix_t client;
    rtps::SampleIdentity identity;  ///< that the reply repeats
  };
  struct Item {
    Request request;
    std::optional<Bytes> reply;  ///< none: to be handled
  };

  static constexpr std::size_t most_requests = 32, most_items = 256;  // beyond them clients time out

  void serve() {
    while (const std::optional<Item> item = queue_->take()) item->reply ? send(*item) : handle(item->request);
  }

  void handle(const Request& request) {
    handler_(request.call.fields, [queue = queue_, request](const Bytes& fields) {
      queue->put({request, reply_payload(request.call, fields)}, most_items);
    });
  }

  void send(const Item& item) {
    matches_.wait_for(item.request.client, std::chrono::milliseconds(100));
    rtps::WriteParams parameters;
    parameters.related_sample_identity(item.request.identity);
    const std::span<const std::uint8_t> bytes(*item.reply);
    writer_->write(const_cast<void*>(static_cast<const void*>(&bytes)), parameters);
  }

  Handler handler_;
  Neighbours& neighbours_;
  MatchListener matches_;
  dds::DataWriter* writer_ = nullptr;
  std::shared_ptr<WorkQueue<Item>> queue_;  ///< the holder of a reply holds it, too
  std::thread thread_;
};

std::vector<std::string> addresses_of(const std::vector<std::string>& interfaces) {
  std::vector<std::string> addresses;
  for (const std::string& name : interfaces) {
    const std::vector<Address> own = own_addresses(name);
    if (own.empty())
      throw std::runtime_error("`reach`: no interface " + name + " with an IPv4 address is here");
    for (const Address& a : own)
      addresses.push_back(std::to_string(a[0]) + "." + std::to_string(a[1]) + "." + std::to_string(a[2]) +
                          "." + std::to_string(a[3]));
  }
  return addresses;
}

dds::DomainParticipantQos participant_qos(const lang::Connection& connection, const std::string& name) {
  const lang::Reach reach = connection.reach;
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name(name);
  // Shared memory would leave out peers by Cyclone, and every peer of another user.
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (reach == lang::Reach::loopback) udp->interfaceWhiteList = {"127.0.0.1"};
  if (!connection.interfaces.empty()) udp->interfaceWhiteList = addresses_of(connection.interfaces);
  // No other computer hears of this process.
  if (reach != lang::Reach::network) udp->TTL = 0;
  qos.transport().user_transports.push_back(udp);
  return qos;
}

}  // namespace

struct Participant::Parts {
  explicit Parts(lang::Reach reach) : neighbours(reach != lang::Reach::machine) {}

  Neighbours neighbours;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::vector<std::unique_ptr<Listener>> listeners;
  std::vector<std::unique_ptr<Service>> services;

  /// By the names that DDS has for them.
  dds::Topic& topic(const std::string& full, const std::string& type_name) {
    dds::TypeSupport(new RawType(type_name)).register_type(participant);
    if (auto* known = dynamic_cast<dds::Topic*>(participant->lookup_topicdescription(full))) return *known;
    dds::Topic* made = participant->create_topic(full, type_name, dds::TOPIC_QOS_DEFAULT);
    if (made == nullptr) throw std::runtime_error("DDS gives no topic " + full);
    return *made;
  }
};

Participant::Participant(const lang::Connection& connection, const std::string& name)
    : parts_(std::make_unique<Parts>(connection.reach)) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  const dds::DomainParticipantQos qos = participant_qos(connection, name);
  parts_->participant = factory->create_participant(static_cast<std::uint32_t>(connection.domain), qos,
                                                    &parts_->neighbours, dds::StatusMask::none());
  if (parts_->participant == nullptr)
    throw std::runtime_error("DDS does not start in domain " + std::to_string(connection.domain));
  parts_->publisher = parts_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  parts_->subscriber = parts_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

Participant::~Participant() {
  close();
}

void Participant::close() noexcept {
  if (parts_->participant == nullptr) return;
  stop_serving();
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
  parts_->participant = nullptr;
}

void Participant::stop_serving() noexcept {
  for (const auto& service : parts_->services) service->stop();
}

void Participant::subscribe(const std::string& topic, const std::string& type,
                            std::function<void(const Payload&)> on_payload, Late late) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  // Best effort finds writers of either kind, and a lost sample is not waited for.
  const bool wants_last = late == Late::gets_last;
  set_up(qos, wants_last ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS, input_depth);
  if (wants_last) qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  parts_->listeners.push_back(std::make_unique<Listener>(std::move(on_payload), parts_->neighbours));
  dds::Topic& of = parts_->topic(dds_topic(topic), dds_type(type));
  if (parts_->subscriber->create_datareader(&of, qos, parts_->listeners.back().get()) == nullptr)
    throw std::runtime_error("DDS gives no reader for " + topic);
}

std::uint64_t Participant::foreign() const noexcept {
  return parts_->neighbours.foreign;
}

std::unique_ptr<Writer> Participant::advertise(const std::string& topic, const std::string& type, Late late) {
  return std::make_unique<DdsWriter>(*parts_->publisher, parts_->topic(dds_topic(topic), dds_type(type)),
                                     late == Late::gets_last);
}

void Participant::serve(const std::string& service, const std::string& type, Handler handler) {
  const std::string dds_name = dds_type(type);
  parts_->services.push_back(std::make_unique<Service>(std::move(handler), parts_->neighbours));
  parts_->services.back()->start(*parts_->publisher, *parts_->subscriber,
                                 parts_->topic(dds_request(service), dds_name + "Request_"),
                                 parts_->topic(dds_reply(service), dds_name + "Response_"));
}

}  // namespace zwang::connect
