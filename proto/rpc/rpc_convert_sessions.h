#pragma once

#include "proto/rpc/rpc_messages.h"
#include "proto/schema/rpc.pb.h"

/// Private to proto/rpc: conversion of the messages that list, create, end, assess and record sessions. `read` returns
/// false if a value is out of its bound.
namespace tandem::rpc {

[[nodiscard]] bool read_listed(const pb::rpc::Session& in, ListedSession& out);
void write_listed(const ListedSession& in, pb::rpc::Session& out);

[[nodiscard]] bool read(const pb::rpc::SessionListRequest& in, SessionListRequest& out);
void write(const SessionListRequest& in, pb::rpc::SessionListRequest& out);
[[nodiscard]] bool read(const pb::rpc::SessionList& in, SessionList& out);
void write(const SessionList& in, pb::rpc::SessionList& out);
[[nodiscard]] bool read(const pb::rpc::CreateSession& in, CreateSession& out);
void write(const CreateSession& in, pb::rpc::CreateSession& out);
[[nodiscard]] bool read(const pb::rpc::SessionCreated& in, SessionCreated& out);
void write(const SessionCreated& in, pb::rpc::SessionCreated& out);
[[nodiscard]] bool read(const pb::rpc::EndSession& in, EndSession& out);
void write(const EndSession& in, pb::rpc::EndSession& out);
[[nodiscard]] bool read(const pb::rpc::Note& in, Note& out);
void write(const Note& in, pb::rpc::Note& out);
[[nodiscard]] bool read(const pb::rpc::SceneListRequest& in, SceneListRequest& out);
void write(const SceneListRequest& in, pb::rpc::SceneListRequest& out);
[[nodiscard]] bool read(const pb::rpc::SceneList& in, SceneList& out);
void write(const SceneList& in, pb::rpc::SceneList& out);
[[nodiscard]] bool read(const pb::rpc::NotesRequest& in, NotesRequest& out);
void write(const NotesRequest& in, pb::rpc::NotesRequest& out);
[[nodiscard]] bool read(const pb::rpc::NoteList& in, NoteList& out);
void write(const NoteList& in, pb::rpc::NoteList& out);
[[nodiscard]] bool read(const pb::rpc::RecordSession& in, RecordSession& out);
void write(const RecordSession& in, pb::rpc::RecordSession& out);
[[nodiscard]] bool read(const pb::rpc::StatusRecording& in, StatusRecording& out);
void write(const StatusRecording& in, pb::rpc::StatusRecording& out);

}  // namespace tandem::rpc
