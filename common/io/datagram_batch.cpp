#include "common/io/datagram_batch.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace tandem::io {
namespace {

constexpr Duration kAgeMax{1'000'000'000};

template <typename T>
T read_control(const cmsghdr* header) noexcept {
  T value;
  std::memcpy(&value, CMSG_DATA(header), sizeof value);
  return value;
}

template <typename T>
void write_control(msghdr& message, int level, int type, const T& value) noexcept {
  cmsghdr* const header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = level;
  header->cmsg_type = type;
  header->cmsg_len = CMSG_LEN(sizeof value);
  std::memcpy(CMSG_DATA(header), &value, sizeof value);
  message.msg_controllen = CMSG_SPACE(sizeof value);
}

}  // namespace

ReceiveBatch::ReceiveBatch() : data_(std::make_unique<std::byte[]>(kMax * kSlotBytes)), control_(kMax) {
  for (std::size_t i = 0; i < kMax; ++i) {
    pieces_[i] = {data_.get() + i * kSlotBytes, kSlotBytes};
    headers_[i].msg_hdr.msg_iov = &pieces_[i];
    headers_[i].msg_hdr.msg_iovlen = 1;
    headers_[i].msg_hdr.msg_name = &from_[i];
    headers_[i].msg_hdr.msg_control = control_[i].bytes.data();
  }
}

void ReceiveBatch::prepare(int fd, int family, bool local, int buffer_bytes) noexcept {
  // All of these are optional: without them datagrams are received with fewer details.
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  setsockopt(fd, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
  // The usual limit holds about 280 small datagrams; root may exceed it.
  if (setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &buffer_bytes, sizeof buffer_bytes) != 0) {
    setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof buffer_bytes);
  }
  if (setsockopt(fd, SOL_SOCKET, SO_SNDBUFFORCE, &buffer_bytes, sizeof buffer_bytes) != 0) {
    setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &buffer_bytes, sizeof buffer_bytes);
  }
  if (!local) return;
  if (family == AF_INET6) {
    setsockopt(fd, IPPROTO_IPV6, IPV6_RECVPKTINFO, &on, sizeof on);
  } else {
    setsockopt(fd, IPPROTO_IP, IP_PKTINFO, &on, sizeof on);
  }
}

int ReceiveBatch::receive(int fd) noexcept {
  for (std::size_t i = 0; i < used_; ++i) {
    msghdr& header = headers_[i].msg_hdr;
    header.msg_namelen = sizeof(sockaddr_storage);
    header.msg_controllen = kControl;
    header.msg_flags = 0;
  }
  const int count = recvmmsg(fd, headers_.data(), kMax, MSG_DONTWAIT, nullptr);
  // The kernel may have changed the header after the last received one before it found no datagram for it.
  used_ = std::min<std::size_t>(count < 0 ? kMax : static_cast<std::size_t>(count) + 1, kMax);
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return 0;
  return count;
}

std::span<const std::byte> ReceiveBatch::bytes(std::size_t i) const noexcept {
  return {data_.get() + i * kSlotBytes, std::min<std::size_t>(headers_[i].msg_len, kSlotBytes)};
}

ReceiveBatch::Details ReceiveBatch::details(std::size_t i, Duration read_at) const noexcept {
  Details details;
  msghdr message = headers_[i].msg_hdr;
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_TIMESTAMPNS) {
      const auto stamp = read_control<timespec>(header);
      details.stamp = std::chrono::seconds(stamp.tv_sec) + Duration{stamp.tv_nsec};
      details.age = std::clamp(read_at - details.stamp, Duration::zero(), kAgeMax);
    } else if (header->cmsg_level == SOL_SOCKET && header->cmsg_type == SO_RXQ_OVFL) {
      details.dropped = read_control<std::uint32_t>(header);
    } else if (header->cmsg_level == IPPROTO_IP && header->cmsg_type == IP_PKTINFO) {
      const auto info = read_control<in_pktinfo>(header);
      details.local.family = AF_INET;
      details.local.v4 = info.ipi_addr;
    } else if (header->cmsg_level == IPPROTO_IPV6 && header->cmsg_type == IPV6_PKTINFO) {
      const auto info = read_control<in6_pktinfo>(header);
      details.local.family = AF_INET6;
      details.local.v6 = info.ipi6_addr;
      details.local.interface_index = info.ipi6_ifindex;
    }
  }
  return details;
}

void SendBatch::add(std::span<const std::byte> bytes, const SocketAddress* to, const LocalAddress* from) noexcept {
  if (count_ == kMax) return;
  msghdr& message = headers_[count_].msg_hdr;
  message = {};
  // sendmmsg only reads these bytes, but its structures also serve reception.
  pieces_[count_] = {const_cast<std::byte*>(bytes.data()), bytes.size()};
  message.msg_iov = &pieces_[count_];
  message.msg_iovlen = 1;
  if (to != nullptr) {
    message.msg_name = const_cast<sockaddr_storage*>(&to->storage);
    message.msg_namelen = to->size;
  }
  if (from != nullptr && from->family != AF_UNSPEC) {
    message.msg_control = control_[count_].bytes.data();
    message.msg_controllen = control_[count_].bytes.size();
    if (from->family == AF_INET) {
      in_pktinfo info{};
      info.ipi_spec_dst = from->v4;
      write_control(message, IPPROTO_IP, IP_PKTINFO, info);
    } else {
      in6_pktinfo info{};
      info.ipi6_addr = from->v6;
      if (IN6_IS_ADDR_LINKLOCAL(&from->v6)) info.ipi6_ifindex = from->interface_index;
      write_control(message, IPPROTO_IPV6, IPV6_PKTINFO, info);
    }
  }
  ++count_;
}

SendBatch::Result SendBatch::send(int fd) noexcept {
  Result result;
  std::size_t next = 0;
  bool retried = false;
  while (next < count_) {
    const int sent =
        sendmmsg(fd, headers_.data() + next, static_cast<unsigned>(count_ - next), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) {
      result.sent += static_cast<std::uint32_t>(sent);
      next += static_cast<std::size_t>(sent);
      retried = false;
      continue;
    }
    if (errno == EINTR) continue;
    if (errno == ECONNREFUSED) {
      // This error concerns an earlier datagram: retry once before dropping this one.
      ++result.refused;
      if (!std::exchange(retried, true)) continue;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) {
      ++result.no_room;
    } else {
      ++result.other;
    }
    ++next;
    retried = false;
  }
  count_ = 0;
  return result;
}

}  // namespace tandem::io
