// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_decoder.h"

#include <shared/plugin_support.h>

#include <algorithm>
#include <exception>
#include <new>

namespace wavemesh {
namespace {

Decoder openedDecoder(const SharedBytes& stream)
{
	auto decoder = Decoder::open(stream->data(), stream->size());
	require(decoder.status(), "Cannot browse the levels");
	return std::move(*decoder);
}

} // namespace

LevelDecoder::LevelDecoder(SharedBytes stream) :
        stream_(std::move(stream)), decoder_(openedDecoder(stream_)), info_(decoder_.info()),
        levels_(info_.levels.size())
{
}

LevelDecoder::~LevelDecoder()
{
	{
		const std::lock_guard lock(mutex_);
		quit_ = true;
	}
	if (thread_.joinable())
		thread_.join();
}

void LevelDecoder::goOn(int level)
{
	const std::lock_guard lock(mutex_);
	goal_ = std::max(goal_, std::min(level, info_.finestLevel()));
	if (working_ || ready_ > goal_ || !status_.ok())
		return;
	if (thread_.joinable())
		thread_.join(); // it has ended, or is about to
	thread_  = std::thread(&LevelDecoder::work, this);
	working_ = true;
}

void LevelDecoder::work()
{
	std::unique_lock lock(mutex_);
	const Progress unlessQuit = [this](double) {
		const std::lock_guard asked(mutex_);
		return !quit_;
	};
	while (ready_ <= goal_ && status_.ok() && !quit_) {
		lock.unlock();
		Status status;
		MeshData mesh;
		bool came = false;
		try {
			status = decoder_.advance(unlessQuit);
			came =
			    (status.ok() || status.code == StatusCode::Truncated) && decoder_.level() == ready_;
			if (came)
				mesh = decoder_.mesh();
		}
		catch (const std::bad_alloc&) {
			status = {StatusCode::OutOfMemory, "not enough memory for the level"};
			came   = false;
		}
		catch (const std::exception& e) { // whoever waits must hear of it, on their own thread
			status = {StatusCode::Internal, e.what()};
			came   = false;
		}
		lock.lock();
		if (came)
			levels_[std::size_t(ready_++)] = std::move(mesh);
		status_ = status;
		changed_.notify_all();
	}
	working_ = false;
	changed_.notify_all();
}

int LevelDecoder::waitFor(int level)
{
	goOn(level);
	std::unique_lock lock(mutex_);
	changed_.wait(lock, [&] { return ready_ > level || !working_; });
	return ready_;
}

int LevelDecoder::finestThatComes()
{
	return waitFor(info_.finestLevel()) - 1;
}

const MeshData& LevelDecoder::at(int level)
{
	if (waitFor(level) <= level)
		require(status_, "Cannot decode the level"); // the thread has ended
	return levels_[std::size_t(level)];
}

void LevelDecoder::forget(int level)
{
	levels_[std::size_t(level)] = {};
}

} // namespace wavemesh
