// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The levels of a stream, decoded ahead while the user is still looking for the slider.
#pragma once

#include <shared/layer_stream.h>

#include <wavemesh/codec.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace wavemesh {

/// Decodes a stream in a thread of its own, from the base mesh to the level asked for, and keeps
/// what it decoded. All levels below the finest together hold less than the
/// finest does, and that as plain arrays: 48 bytes a vertex, a quarter of a MeshLab mesh.
///
/// To be used by one thread; the one that decodes is not seen.
class LevelDecoder
{
public:
	/// Reads the head. @throws MLException
	explicit LevelDecoder(SharedBytes stream);
	/// Waits for the decoding to stop: for a part of a level at most.
	~LevelDecoder();
	LevelDecoder(const LevelDecoder&)            = delete;
	LevelDecoder& operator=(const LevelDecoder&) = delete;

	const SharedBytes& stream() const { return stream_; }
	const StreamInfo& info() const { return info_; }

	/// Goes on up to this level, and returns at once.
	void goOn(int level);

	/// Waits until everything was decoded that there is. @return the finest level that came; -1:
	/// none. A cut file has fewer than its head says, the last maybe in part.
	int finestThatComes();

	/// A level, after a wait if it has yet to be decoded. @throws MLException, if it does not come.
	/// @pre it was not forgotten
	const MeshData& at(int level);
	/// Does not keep this level any longer. @pre at() has given it
	void forget(int level);

private:
	void work();
	/// Waits for this level, or for the end of the decoding. @return how many levels are there
	int waitFor(int level);

	SharedBytes stream_; ///< what decoder_ reads
	Decoder decoder_;    ///< of the thread alone
	StreamInfo info_;
	std::vector<MeshData> levels_; ///< the first ready_ are there

	std::mutex mutex_; ///< for what follows
	std::condition_variable changed_;
	int ready_    = 0;
	int goal_     = -1;
	bool working_ = false;
	bool quit_    = false;
	Status status_; ///< not ok: no more will come
	std::thread thread_;
};

} // namespace wavemesh
