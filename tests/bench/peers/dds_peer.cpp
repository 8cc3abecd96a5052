// Cyclone DDS: best effort, the newest sample of each client, which is an instance of one topic.
#include <dds/dds.h>
#include <peer_messages.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

#include "common/io/clock.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/udp_load.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Loopback only, no multicast, and port numbers of their own.
constexpr const char* kSettings =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";
constexpr dds_domainid_t kDomain = 77;

/// Reads one topic and writes another.
class DdsEnd {
 public:
  DdsEnd(const std::string& in, const std::string& out) {
    setenv("CYCLONEDDS_URI", kSettings, 1);
    const dds_entity_t participant = dds_create_participant(kDomain, nullptr, nullptr);
    if (participant < 0) throw std::runtime_error(std::string("DDS: ") + dds_strretcode(participant));
    dds_qos_t* const quality = dds_create_qos();
    dds_qset_reliability(quality, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_history(quality, DDS_HISTORY_KEEP_LAST, 1);
    const auto topic = [&](const std::string& name) {
      return dds_create_topic(participant, &peers_Sample_desc, name.c_str(), nullptr, nullptr);
    };
    reader_ = dds_create_reader(participant, topic(in), quality, nullptr);
    writer_ = dds_create_writer(participant, topic(out), quality, nullptr);
    dds_delete_qos(quality);
    dds_set_status_mask(reader_, DDS_DATA_AVAILABLE_STATUS);
    wait_set_ = dds_create_waitset(participant);
    dds_waitset_attach(wait_set_, reader_, 0);
    if (reader_ < 0 || writer_ < 0 || wait_set_ < 0) throw std::runtime_error("DDS gives no reader or writer");
  }
  void wait_for_other_end() const {
    for (int i = 0; i < 200; ++i, UdpLoad::pause_until(io::monotonic_now().time_since_epoch() + 50ms)) {
      dds_publication_matched_status_t readers;
      dds_subscription_matched_status_t writers;
      if (dds_get_publication_matched_status(writer_, &readers) == 0 && readers.current_count > 0 &&
          dds_get_subscription_matched_status(reader_, &writers) == 0 && writers.current_count > 0)
        return;
    }
    throw std::runtime_error("the ends do not find each other");
  }
  void write(std::size_t client, std::span<std::byte> bytes) const {
    peers_Sample sample{};
    sample.client = static_cast<std::uint32_t>(client);
    sample.body._maximum = sample.body._length = static_cast<std::uint32_t>(bytes.size());
    sample.body._buffer = reinterpret_cast<std::uint8_t*>(bytes.data());
    dds_write(writer_, &sample);
  }
  /// Waits for samples and calls `each(client, bytes)`.
  template <class Each>
  void read(dds_duration_t wait, const Each& each) {
    dds_attach_t triggered = 0;
    if (dds_waitset_wait(wait_set_, &triggered, 1, wait) <= 0) return;
    std::array<void*, 64> samples{};
    std::array<dds_sample_info_t, 64> about;
    for (int count; (count = dds_take(reader_, samples.data(), about.data(), samples.size(), samples.size())) > 0;) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const auto& sample = *static_cast<const peers_Sample*>(samples[i]);
        if (about[i].valid_data)
          each(sample.client, std::span{reinterpret_cast<const std::byte*>(sample.body._buffer), sample.body._length});
      }
      dds_return_loan(reader_, samples.data(), count);
    }
  }

 private:
  dds_entity_t reader_ = 0, writer_ = 0, wait_set_ = 0;
};

class DdsClients final : public PeerClients {
 public:
  DdsClients(const Exchange& exchange, const std::string& name)
      : times_(exchange), message_(exchange.up), end_("down" + name, "up" + name) {
    end_.wait_for_other_end();
  }
  void send(std::size_t client) override {
    times_.stamp(client, message_);
    end_.write(client, message_);
  }
  void receive(Time until, const Heard& heard) override {
    for (Duration left; (left = until - io::monotonic_now()) > Duration{};)
      end_.read(left.count(), [&](std::size_t, std::span<const std::byte> bytes) { times_.hear(bytes, heard); });
  }

 private:
  SendTimes times_;
  std::vector<std::byte> message_;
  DdsEnd end_;
};

class DdsPeer final : public Peer {
 public:
  explicit DdsPeer(const Exchange& exchange) : exchange_(exchange) {}
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    DdsEnd end("up" + name_, "down" + name_);
    ready(0);
    std::vector<std::byte> answer(exchange_.down);
    for (;;)
      end.read(DDS_INFINITY, [&](std::size_t client, std::span<const std::byte> bytes) {
        std::memcpy(answer.data(), bytes.data(), std::min(bytes.size(), sizeof(Mark)));
        end.write(client, answer);
      });
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t) override {
    return std::make_unique<DdsClients>(exchange_, name_);
  }

 private:
  Exchange exchange_;
  std::string name_ = std::to_string(getpid());  ///< topics of this run only
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) {
  // DDS Security asks for signed documents of permissions per participant: not compared.
  if (exchange.sealed) return nullptr;
  return std::make_unique<DdsPeer>(exchange);
}

}  // namespace tandem::bench
