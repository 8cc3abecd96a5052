#include "server/console/app/live_socket.h"

#include <boost/beast/websocket.hpp>
#include <utility>

#include "common/io/clock.h"
#include "server/console/app/live_page.h"

namespace tandem::console {
namespace {

namespace beast = boost::beast;
namespace net = boost::asio;
namespace websocket = beast::websocket;

constexpr std::chrono::seconds kWriteTimeout{5};
constexpr std::chrono::seconds kHandshakeTimeout{30};
constexpr std::chrono::seconds kSilence{20};  // of a browser that answers no ping; it is sent after half of this
constexpr auto kSignIn = static_cast<websocket::close_code>(4401);  // private use [RFC 6455, 7.4.2]
constexpr auto kNoSession = static_cast<websocket::close_code>(4404);

class BeastSocket final : public LiveSocket {
 public:
  BeastSocket(WebStream stream, Gateway& gateway, LiveSockets& sockets, std::shared_ptr<Person> person,
              std::string cookie, ConnectionSlot slot)
      : stream_(std::move(stream)),
        gateway_(gateway),
        sockets_(sockets),
        person_(std::move(person)),
        cookie_(std::move(cookie)),
        slot_(std::move(slot)) {
    sockets_.insert(this);
    if (person_) gateway_.browsers().opened(cookie_);
  }
  ~BeastSocket() override {
    sockets_.erase(this);
    if (person_) gateway_.browsers().closed(cookie_, io::monotonic_now());
  }
  BeastSocket(const BeastSocket&) = delete;
  BeastSocket& operator=(const BeastSocket&) = delete;

  void start(const Request& request) {
    stream_.set_option(websocket::stream_base::timeout{kHandshakeTimeout, kSilence, true});
    stream_.read_message_max(kFrameMax);
    stream_.text(true);
    stream_.async_accept(request, [self = self()](beast::error_code error) {
      if (!error) self->opened();
    });
  }

  void on_news() override {
    if (!open_) return;
    page_->on_news();
    if (page_->overflowed()) drop();
  }

  void on_period(std::chrono::steady_clock::time_point now) override {
    if (!open_) return;
    if (writing_ && now - write_begin_ > kWriteTimeout) return drop();  // the browser stalled
    page_->on_period(now);
    if (page_->overflowed()) drop();
  }

 private:
  [[nodiscard]] std::shared_ptr<BeastSocket> self() {
    return std::static_pointer_cast<BeastSocket>(shared_from_this());
  }

  void opened() {
    open_ = true;
    if (!person_) return close({kSignIn, "sign in with a ticket: /join"});
    if (person_->link == nullptr) return close({kNoSession, "this gateway plays recordings only"});
    page_ = std::make_shared<LivePage>(gateway_, person_, [this] {
      if (open_ && !writing_) write();
    });
    page_->on_period(std::chrono::steady_clock::now());
    read();
  }

  void drop() {
    open_ = false;
    beast::get_lowest_layer(stream_).close();
  }

  void write() {
    writing_ = true;
    write_begin_ = std::chrono::steady_clock::now();
    stream_.async_write(net::buffer(page_->queue().front()), [self = self()](beast::error_code error, std::size_t) {
      self->writing_ = false;
      self->page_->queue().pop_front();
      if (error) self->open_ = false;  // the read that is pending ends too, after its close frame if it sends one
      if (self->open_ && !self->page_->queue().empty()) self->write();
    });
  }

  void read() {
    stream_.async_read(buffer_, [self = self()](beast::error_code error, std::size_t) {
      if (error || !self->open_) {
        self->open_ = false;
        return;
      }
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (!self->stream_.got_text()) return self->close({websocket::close_code::policy_error, "send text frames"});
      if (const std::string why = self->page_->on_frame(text); !why.empty())
        return self->close({websocket::close_code::policy_error, beast::string_view(why.data(), why.size())});
      if (self->open_) self->read();
    });
  }

  void close(const websocket::close_reason& why) {
    open_ = false;
    if (writing_) return drop();  // a close frame must not overtake a message
    stream_.async_close(why, [self = self()](beast::error_code) {});
  }

  websocket::stream<WebStream> stream_;
  Gateway& gateway_;
  LiveSockets& sockets_;
  std::shared_ptr<Person> person_;
  std::string cookie_;
  ConnectionSlot slot_;
  std::shared_ptr<LivePage> page_;
  beast::flat_buffer buffer_;
  std::chrono::steady_clock::time_point write_begin_{};
  bool open_ = false, writing_ = false;
};

}  // namespace

void open_live_socket(WebStream stream, const Request& request, Gateway& gateway, LiveSockets& sockets,
                      std::shared_ptr<Person> person, std::string cookie, ConnectionSlot slot) {
  std::make_shared<BeastSocket>(std::move(stream), gateway, sockets, std::move(person), std::move(cookie),
                                std::move(slot))
      ->start(request);
}

}  // namespace tandem::console
