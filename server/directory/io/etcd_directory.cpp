#include "server/directory/io/etcd_directory.h"

#include <grpc/grpc.h>
#include <grpc/support/log.h>
#include <grpc/support/time.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "server/directory/io/etcd_channel.h"
#include "server/directory/io/etcd_codec.h"
#include "server/directory/io/keeps_lease.h"

namespace tandem::directory {

namespace {

constexpr std::size_t kRepliesMax = 65536;
/// While no member answers, or the one that does is full, a failure is passed on only after this time. Callers try
/// again at each failure, and would otherwise do nothing else.
constexpr std::chrono::milliseconds kFailurePause{100};
using std::chrono::steady_clock;

using Context = std::shared_ptr<grpc::ClientContext>;

/// Stubs of one member.
struct Member {
  explicit Member(const std::shared_ptr<grpc::Channel>& channel)
      : kv(etcdserverpb::KV::NewStub(channel)),
        lease(etcdserverpb::Lease::NewStub(channel)),
        watch(etcdserverpb::Watch::NewStub(channel)) {}
  std::unique_ptr<etcdserverpb::KV::Stub> kv;
  std::unique_ptr<etcdserverpb::Lease::Stub> lease;
  std::unique_ptr<etcdserverpb::Watch::Stub> watch;
};

}  // namespace

/// Queues, connections and open calls. `stop` waits for the last call, because gRPC's threads may not end a connection.
class EtcdDirectory::Core {
 public:
  explicit Core(EtcdOptions options) : options_(std::move(options)) {}

  void start() {
    // gRPC stays until the program ends: its threads may still be leaving a callback when the last connection ends.
    static const bool once = [] {
      grpc_init();
      gpr_set_log_function([](gpr_log_func_args*) {});  // it would write to standard error; replies have the reasons
      return true;
    }();
    static_cast<void>(once);
    thread_ = std::thread([this] { run(); });
  }
  void stop() {
    std::set<Context> open;
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
      open = contexts_;
    }
    for (const Context& context : open) context->TryCancel();  // may run callbacks, which lock
    wake_.notify_all();
    thread_.join();
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return contexts_.empty(); });
  }

  void begin(OperationId operation, const Request& request) {
    const std::lock_guard lock(mutex_);
    ++counters_.begun;
    if (requests_.size() + contexts_.size() >= (keeps_lease(request) ? kOpenMax : kOpenMax - kReserved)) {
      ++counters_.overflowed;
      return push(unknown(operation, "too many requests are open"));
    }
    requests_.emplace_back(operation, request);
    wake_.notify_all();
  }
  std::optional<Reply> poll() {
    const std::lock_guard lock(mutex_);
    if (replies_.empty()) return std::nullopt;
    Reply reply = std::move(replies_.front());
    replies_.pop_front();
    return reply;
  }
  void notify_by(const std::function<void()>& told) {
    const std::lock_guard lock(mutex_);
    told_ = told;
  }
  Counters counters() const {
    const std::lock_guard lock(mutex_);
    return counters_;
  }

  /// Registers an open call. Returns false when the directory ends: the call must not begin.
  bool open(const Context& context) {
    const std::lock_guard lock(mutex_);
    if (stopped_) return false;
    contexts_.insert(context);
    return true;
  }
  void close(Context context) {
    const std::lock_guard lock(mutex_);
    contexts_.erase(context);
    context.reset();
    wake_.notify_all();
  }
  /// Queues a reply. Returns false if the queue is full: the result is then unknown, and a watch ends.
  bool answer(Reply reply) {
    const std::lock_guard lock(mutex_);
    const bool fits = replies_.size() < kRepliesMax;
    if (!fits) {
      reply = unknown(reply.operation, "replies are not taken");
      ++counters_.overflowed;
    }
    failed_members_ = 0;
    push(std::move(reply));
    return fits;
  }
  /// Takes the failure of a call to the member with this number.
  void fail(OperationId operation, const grpc::Status& status, std::size_t member) {
    const std::lock_guard lock(mutex_);
    Reply reply = failed(operation, status);
    // The member is there: it is full, as all others are, has too many requests, or got a message that is too large.
    const bool exhausted = status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
    if (exhausted) {
      failed_members_ = 0;
    } else if (reply.outcome == Outcome::kUnknown && member == member_) {
      member_ = (member_ + 1) % options_.endpoints.size();
      ++counters_.endpoint_changes;
      ++failed_members_;
    }
    const bool pause = exhausted || failed_members_ >= options_.endpoints.size();
    if (reply.outcome != Outcome::kUnknown || !pause) return push(std::move(reply));
    held_back_.emplace_back(steady_clock::now() + kFailurePause, std::move(reply));
    wake_.notify_all();
  }
  [[nodiscard]] gpr_timespec deadline() const {
    return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC), gpr_time_from_nanos(options_.answer_limit.count(), GPR_TIMESPAN));
  }

 private:
  static Reply unknown(OperationId operation, const char* reason) {
    Reply reply;
    reply.operation = operation;
    reply.outcome = Outcome::kUnknown;
    reply.reason = reason;
    return reply;
  }
  void push(Reply reply) {
    if (reply.outcome == Outcome::kUnknown) ++counters_.unknown;
    if (reply.outcome == Outcome::kRefused) ++counters_.refused;
    replies_.push_back(std::move(reply));
    if (told_) told_();
  }
  void run();
  void pass_on_held_back();
  void begin_call(OperationId operation, const Request& request, std::size_t member);
  Member& member(std::size_t number);

  EtcdOptions options_;
  std::map<std::size_t, Member> members_;  ///< of this thread only
  std::thread thread_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::pair<OperationId, Request>> requests_;
  std::deque<Reply> replies_;
  std::deque<std::pair<steady_clock::time_point, Reply>> held_back_;  ///< failures, with the time to pass them on
  std::size_t failed_members_ = 0;                                    ///< changes of the member since the newest answer
  std::function<void()> told_;
  std::set<Context> contexts_;  ///< of the open calls
  std::size_t member_ = 0;
  bool stopped_ = false;
  Counters counters_;
};

namespace {

using Core = EtcdDirectory::Core;

/// Deletes a call that has ended, then reports its end. The core may be gone after that.
template <class AnyCall>
void end_call(Core& core, const AnyCall* call, Context context) {
  delete call;
  core.close(std::move(context));
}

/// One call with one answer. It deletes itself after its end.
template <class Wanted, class Answer>
struct Call {
  Core* core = nullptr;
  OperationId operation = 0;
  std::size_t member = 0;
  Context context = std::make_shared<grpc::ClientContext>();
  Wanted wanted{};
  Answer answer{};

  /// @param start  begins the call with the callback that it is given
  template <class Start>
  static void begin(Core* core, OperationId operation, std::size_t member, Wanted wanted, Start start) {
    auto* call = new Call{core, operation, member};
    call->wanted = std::move(wanted);
    call->context->set_deadline(call->core->deadline());
    if (!call->core->open(call->context)) {
      delete call;
      return;
    }
    start(*call, [call](const grpc::Status& status) { call->end(status); });
  }
  void end(const grpc::Status& status) {
    if (!status.ok()) {
      core->fail(operation, status, member);
    } else if constexpr (requires { from_etcd(operation, answer); }) {
      core->answer(from_etcd(operation, answer));
    } else {
      core->answer(from_header(operation, answer.header()));
    }
    end_call(*core, this, context);
  }
};

/// One renewal: a stream that carries one message in each direction.
class Renewal final
    : public grpc::ClientBidiReactor<etcdserverpb::LeaseKeepAliveRequest, etcdserverpb::LeaseKeepAliveResponse> {
 public:
  Renewal(Core* core, OperationId operation, std::size_t member, LeaseId lease)
      : core_(core), operation_(operation), member_(member) {
    wanted_.set_id(lease);
    context_->set_deadline(core_->deadline());
  }
  void start(etcdserverpb::Lease::Stub& stub) {
    if (!core_->open(context_)) {
      delete this;
      return;
    }
    stub.async()->LeaseKeepAlive(context_.get(), this);
    StartWriteLast(&wanted_, grpc::WriteOptions());
    StartRead(&answer_);
    StartCall();
  }
  void OnReadDone(bool good) override {
    if (!good || answered_) return;
    answered_ = true;
    core_->answer(from_etcd(operation_, answer_));
    StartRead(&answer_);
  }
  void OnDone(const grpc::Status& status) override {
    if (!answered_)
      core_->fail(operation_, status.ok() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the stream ended") : status,
                  member_);
    end_call(*core_, this, context_);
  }

 private:
  Core* core_;
  OperationId operation_;
  std::size_t member_;
  bool answered_ = false;
  Context context_ = std::make_shared<grpc::ClientContext>();
  etcdserverpb::LeaseKeepAliveRequest wanted_;
  etcdserverpb::LeaseKeepAliveResponse answer_;
};

/// A watch, until etcd or the connection ends it.
class OpenWatch final : public grpc::ClientBidiReactor<etcdserverpb::WatchRequest, etcdserverpb::WatchResponse> {
 public:
  OpenWatch(Core* core, OperationId operation, std::size_t member, const Watch& watch)
      : core_(core), operation_(operation), member_(member), wanted_(to_etcd(watch)) {
    context_->AddMetadata("hasleader", "true");  // a member that has lost its quorum ends the watch
  }
  void start(etcdserverpb::Watch::Stub& stub) {
    if (!core_->open(context_)) {
      delete this;
      return;
    }
    stub.async()->Watch(context_.get(), this);
    StartWrite(&wanted_);
    StartRead(&answer_);
    StartCall();
  }
  void OnReadDone(bool good) override {
    if (!good || ended_) return;
    Reply reply = from_etcd(operation_, answer_);
    ended_ = reply.outcome != Outcome::kDone;
    if (ended_ || answer_.created() || !reply.changes.empty()) ended_ |= !core_->answer(std::move(reply));
    if (ended_)
      context_->TryCancel();
    else
      StartRead(&answer_);
  }
  void OnDone(const grpc::Status& status) override {
    if (!ended_) core_->fail(operation_, grpc::Status(grpc::StatusCode::UNAVAILABLE, status.error_message()), member_);
    end_call(*core_, this, context_);
  }

 private:
  Core* core_;
  OperationId operation_;
  std::size_t member_;
  bool ended_ = false;
  Context context_ = std::make_shared<grpc::ClientContext>();
  etcdserverpb::WatchRequest wanted_;
  etcdserverpb::WatchResponse answer_;
};

}  // namespace

void EtcdDirectory::Core::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    if (held_back_.empty())
      wake_.wait(lock, [this] { return stopped_ || !requests_.empty() || !held_back_.empty(); });
    else
      wake_.wait_until(lock, held_back_.front().first, [this] { return stopped_ || !requests_.empty(); });
    if (stopped_) return;
    pass_on_held_back();
    if (requests_.empty()) continue;
    auto [operation, request] = std::move(requests_.front());
    requests_.pop_front();
    const std::size_t number = member_;
    lock.unlock();
    begin_call(operation, request, number);
    lock.lock();
  }
}

void EtcdDirectory::Core::pass_on_held_back() {
  const auto now = steady_clock::now();
  while (!held_back_.empty() && held_back_.front().first <= now) {
    push(std::move(held_back_.front().second));
    held_back_.pop_front();
  }
}

Member& EtcdDirectory::Core::member(std::size_t number) {
  const auto found = members_.find(number);
  if (found != members_.end()) return found->second;
  return members_.emplace(number, etcd_channel(options_, number)).first->second;
}

void EtcdDirectory::Core::begin_call(OperationId operation, const Request& request, std::size_t number) {
  using namespace etcdserverpb;
  Member& to = member(number);
  Core* const self = this;
  if (const auto* grant = std::get_if<Grant>(&request)) {
    LeaseGrantRequest wanted;
    wanted.set_ttl(std::chrono::ceil<std::chrono::seconds>(grant->ttl).count());
    Call<LeaseGrantRequest, LeaseGrantResponse>::begin(self, operation, number, wanted, [&to](auto& call, auto end) {
      to.lease->async()->LeaseGrant(call.context.get(), &call.wanted, &call.answer, end);
    });
  } else if (const auto* renew = std::get_if<Renew>(&request)) {
    (new Renewal(self, operation, number, renew->lease))->start(*to.lease);
  } else if (const auto* revoke = std::get_if<Revoke>(&request)) {
    LeaseRevokeRequest wanted;
    wanted.set_id(revoke->lease);
    Call<LeaseRevokeRequest, LeaseRevokeResponse>::begin(self, operation, number, wanted, [&to](auto& call, auto end) {
      to.lease->async()->LeaseRevoke(call.context.get(), &call.wanted, &call.answer, end);
    });
  } else if (const auto* remaining = std::get_if<Remaining>(&request)) {
    LeaseTimeToLiveRequest wanted;
    wanted.set_id(remaining->lease);
    Call<LeaseTimeToLiveRequest, LeaseTimeToLiveResponse>::begin(
        self, operation, number, wanted, [&to](auto& call, auto end) {
          to.lease->async()->LeaseTimeToLive(call.context.get(), &call.wanted, &call.answer, end);
        });
  } else if (const auto* transaction = std::get_if<Transaction>(&request)) {
    Call<TxnRequest, TxnResponse>::begin(self, operation, number, to_etcd(*transaction), [&to](auto& call, auto end) {
      to.kv->async()->Txn(call.context.get(), &call.wanted, &call.answer, end);
    });
  } else if (const auto* watch = std::get_if<directory::Watch>(&request)) {
    (new OpenWatch(self, operation, number, *watch))->start(*to.watch);
  } else if (const auto* compact = std::get_if<Compact>(&request)) {
    CompactionRequest wanted;
    wanted.set_revision(compact->until);
    Call<CompactionRequest, CompactionResponse>::begin(self, operation, number, wanted, [&to](auto& call, auto end) {
      to.kv->async()->Compact(call.context.get(), &call.wanted, &call.answer, end);
    });
  }
}

EtcdDirectory::EtcdDirectory(EtcdOptions options) : core_(std::make_unique<Core>(std::move(options))) {
  core_->start();
}
EtcdDirectory::~EtcdDirectory() { core_->stop(); }
void EtcdDirectory::begin(OperationId operation, const Request& request) { core_->begin(operation, request); }
std::optional<Reply> EtcdDirectory::poll() { return core_->poll(); }
void EtcdDirectory::notify_by(const std::function<void()>& told) { core_->notify_by(told); }
EtcdDirectory::Counters EtcdDirectory::counters() const { return core_->counters(); }

}  // namespace tandem::directory
