#include "server/console/app/live_page.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "common/io/clock.h"
#include "server/console/live_json.h"
#include "server/console/recording_request.h"
#include "server/console/seat_picture.h"
#include "server/console/state_json.h"

namespace tandem::console {
namespace {

/// Whether a page that knows `a` needs no new hello. It has the phase of the session that it watches from `state`.
bool same(const std::vector<rpc::ListedSession>& a, const std::vector<rpc::ListedSession>& b, const rpc::Id& watched) {
  return std::ranges::equal(a, b, [&watched](const rpc::ListedSession& x, const rpc::ListedSession& y) {
    return x.id == y.id && x.name == y.name && (x.phase == y.phase || x.id == watched);
  });
}

/// Number of the stop in force; 0: none.
std::uint32_t number_of(const std::optional<rpc::StatusStop>& stop) {
  return stop && !stop->ends.empty() ? stop->number : 0;
}

}  // namespace

LivePage::LivePage(Gateway& gateway, std::shared_ptr<Person> person, std::function<void()> flush)
    : gateway_(gateway), person_(std::move(person)), flush_(std::move(flush)), link_(person_->link), view_(link_) {}

LivePage::~LivePage() {
  if (seat_) seat_->leave();
}

void LivePage::send(std::string text) {
  if (overflowed_) return;
  if (queue_.size() >= kQueueMax) {
    overflowed_ = true;
    return;
  }
  queue_.push_back(std::move(text));
  flush_();
}

void LivePage::choose_view() {
  auto best = gateway_.best_view(link_);
  if (best == view_) return;
  view_ = std::move(best);
  shown_ = 0;
}

void LivePage::on_period(std::chrono::steady_clock::time_point now) {
  if (now - second_ >= std::chrono::seconds{1}) {
    second_ = now;
    frames_ = 0;
  }
  choose_view();
  const auto own = link_->newest(), view = view_->newest();
  link_->set_relieved(view_ != link_);
  // Only this person's connection knows whether they may end a stop.
  if (view_ != link_ && number_of(view->status.stop) != number_of(own->status.stop)) link_->poke();
  if (auto sessions = gateway_.sessions_of(*person_); greeted_ && !same(sessions, listed_, own->status.session_id))
    greet();
  on_news();
}

void LivePage::greet() {
  const auto own = link_->newest();
  listed_ = gateway_.sessions_of(*person_);
  role_ = own->role;
  greeted_ = true;
  scenes_ = own->scenes;
  const PageOffers offers{.seats = gateway_.seats().allowed() && !person_->audience,
                          .invite = person_->house,
                          .play = gateway_.play(),
                          .proved = person_->proved,
                          .recordings = gateway_.has_recordings(),
                          .scenes = scenes_.get(),
                          .workstation = gateway_.workstation()};
  send(hello_json(person_->name, role_, gateway_.release(), listed_, offers));
}

void LivePage::on_news() {
  const auto own = link_->newest(), view = view_->newest();
  if (own->number == 0 || view->number == 0) return;  // still joining
  const bool scenes = own->scenes && (!scenes_ || *own->scenes != *scenes_);
  if (!greeted_ || own->role != role_ || scenes) greet();
  send_notices(*own, *view);
  send_notes(*own);
  send_scores(*own);
  send_seat();
  if (view->number == shown_) return;
  const bool first = shown_ == 0;
  shown_ = view->number;
  if (first || !view->live) {  // datagrams do not change the scene
    if (std::string scene = scene_json(*view); scene != scene_) {
      scene_ = std::move(scene);
      send(scene_);
    }
  }
  send_events(view->status);
  send_state(*own, *view);
}

void LivePage::send_notices(const LivePicture& own, const LivePicture& view) {
  const bool gives_up = !own.connected && again_ && !own.again;
  again_ = own.again;
  if (own.connected != connected_ || gives_up) {
    connected_ = own.connected;
    const std::string lost = "the connection to the server was lost (" + own.warning + "); ";
    if (connected_) {
      send(notice_json("info", "the connection to the server is back", "back"));
    } else if (own.again) {
      send(notice_json("error", lost + "trying again", "lost"));
    } else {
      send(notice_json("error", lost + "sign in again with a new ticket", "gone"));
    }
  }
  if (const bool held = own.connected && own.status.phase == rpc::SessionPhase::kHeld; held != held_) {
    held_ = held;
    if (held) send(notice_json("warning", "the session is held: " + own.status.held));
    if (!held && own.connected) send(notice_json("info", "the session is held no longer"));
  }
  const std::string warning = view.live || !own.connected ? std::string{} : view.warning;
  if (warning == warning_ || (warning.empty() && !view.live)) return;
  warning_ = warning;
  send(warning.empty() ? notice_json("info", "live values are there") : notice_json("warning", warning));
}

void LivePage::send_events(const rpc::Status& status) {
  if (!status.events.empty() && status.events.back().number < event_) event_ = 0;  // another run of the session
  for (const rpc::StatusEvent& event : status.events) {
    if (event.number <= event_) continue;
    event_ = event.number;
    send(event_json(status.session_id, event));
  }
}

void LivePage::send_state(const LivePicture& own, const LivePicture& view) {
  if (!queue_.empty()) return window_.drop();
  const std::uint64_t n = window_.next();
  if (n == 0) return;
  std::optional<rpc::StatusStop> stop = view.status.stop;
  if (stop) stop->yours = number_of(own.status.stop) == stop->number && own.status.stop->yours;
  StateHead head{.n = n, .dropped = window_.dropped(), .age_ms = {}, .stop = &stop};
  const Time now = io::monotonic_now();
  head.wall_us = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
  if (view.live) head.age_ms = 1e3 * seconds(now - view.live->arrived);
  send(state_json(head, view_->state_members(view)));
}

std::string LivePage::on_frame(std::string_view text) {
  if (++frames_ > kFramesPerSecond) return "more than 240 frames within one second";
  const auto own = link_->newest();
  auto frame = parse_browser_frame(text, own->role, own->status.session_id);
  if (!frame) {
    if (frame.error().close) return "the frame is no JSON object";
    send(reply_json(frame.error().id, false, frame.error().text));
  } else if (const auto* ack = std::get_if<Ack>(&*frame)) {
    if (!window_.acknowledge(ack->n)) send(reply_json({}, false, "\"n\" names a state that was never sent"));
  } else if (const auto* wish = std::get_if<Watch>(&*frame)) {
    watch(*wish);
  } else if (auto* order = std::get_if<Order>(&*frame)) {
    give(std::move(*order));
  } else if (const auto* seat = std::get_if<TakeSeat>(&*frame)) {
    take(*seat);
  } else if (const auto* leaving = std::get_if<LeaveSeat>(&*frame)) {
    leave(*leaving);
  } else if (const auto* pointer = std::get_if<Pointer>(&*frame)) {
    point(*pointer);
  } else if (const auto* invited = std::get_if<Invite>(&*frame)) {
    invite(*invited);
  } else if (const auto* noted = std::get_if<MarkFrame>(&*frame)) {
    mark(*noted);
  } else if (const auto* filled = std::get_if<SheetFrame>(&*frame)) {
    sheet(*filled);
  }
  return {};
}

void LivePage::watch(const Watch& wish) {
  auto link = gateway_.open(*person_, wish.session);
  if (!link) return send(reply_json(wish.id, false, "unknown session; choose one of the message hello"));
  send(reply_json(wish.id, true, ""));
  link_ = view_ = std::move(link);
  shown_ = 0;
  event_ = 0;
  scene_.clear();
  notes_.reset();
  scores_.reset();
  warning_.clear();
  choose_view();
  on_news();
}

void LivePage::give(Order order) { ask(order.id, std::move(order.body)); }

/// Sends an order over the person's connection, and the reply to the page.
void LivePage::ask(std::uint64_t id, rpc::Body body) {
  auto reply = [weak = weak_from_this(), &mailbox = gateway_.mailbox(), id](bool ok, std::string said,
                                                                            std::string message) {
    mailbox.post([weak, id, ok, said = std::move(said), message = std::move(message)] {
      const auto self = weak.lock();
      if (!self) return;
      self->send(reply_json(id, ok, said));
      if (!message.empty()) self->send(message);
    });
  };
  if (!link_->order(std::move(body), std::move(reply)))
    send(reply_json(id, false, "16 orders already wait for the server; repeat this one in a second"));
}

// The server judges and stores a note with its author; the page shows it once the server lists it.
void LivePage::mark(const MarkFrame& frame) {
  ask(frame.id, rpc::Note{link_->newest()->status.session_id, rpc::NoteKind::kMark,
                          mark_json(person_->name, frame.t_s, frame.text)});
}

void LivePage::sheet(const SheetFrame& frame) {
  ask(frame.id,
      rpc::Note{link_->newest()->status.session_id, rpc::NoteKind::kSheet, sheet_json(person_->name, frame.sheet)});
}

void LivePage::send_notes(const LivePicture& own) {
  if (own.notes == notes_ || !own.notes) return;
  notes_ = own.notes;
  send(notes_->message());
}

void LivePage::send_scores(const LivePicture& own) {
  if (!may_review(own.role)) return;
  auto newest = gateway_.scores_of(own.status.session_id);
  if (!newest || newest == scores_) return;
  scores_ = std::move(newest);
  send(*scores_);
}

// The gateway's own right may take any seat, so it serves only persons who have the gateway's connection.
void LivePage::take(const TakeSeat& wish) {
  if (seat_ && !seat_->over()) return send(reply_json(wish.id, false, "this page has a seat already; leave it first"));
  if (person_->audience)
    return send(reply_json(wish.id, false, "the audience only watches; sign in at /join with a ticket"));
  if (!person_->house && wish.ticket.empty())
    return send(reply_json(wish.id, false, "a ticket for this seat is needed; ask the operator of the server for one"));
  auto seat = gateway_.seats().take(link_->newest()->status.name, wish.seat, wish.ticket);
  if (!seat) return send(reply_json(wish.id, false, seat.error()));
  seat_ = std::move(*seat);
  send(reply_json(wish.id, true, ""));
}

void LivePage::leave(const LeaveSeat& wish) {
  if (!seat_) return send(reply_json(wish.id, false, "this page has no seat"));
  seat_->leave();
  send(reply_json(wish.id, true, ""));
}

void LivePage::point(const Pointer& pointer) {
  if (seat_) seat_->point(pointer.x, pointer.pressed, io::monotonic_now());
}

void LivePage::invite(const Invite& wish) {
  if (!person_->house)
    return send(reply_json(wish.id, false,
                           "only a person with the gateway's own connection may invite; others need a "
                           "ticket"));
  send(reply_json(wish.id, true, "/?token=" + gateway_.make_token(io::monotonic_now())));
}

void LivePage::send_seat() {
  if (!seat_ || !queue_.empty()) return;  // lossy, as `state` is
  const SeatPicture picture = seat_->newest();
  std::string words = seat_json(picture);
  if (words != seat_words_) {
    seat_words_ = words;
    send(std::move(words));
  }
  if (!picture.ended.empty()) seat_.reset();
}

}  // namespace tandem::console
