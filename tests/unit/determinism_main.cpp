// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a hash of the bytes of several meshes' files and of the mesh that each decodes to.
// Compiled by several compilers at several levels of optimisation; what they print must be the
// same.
#include "mesh_families.h"

#include <wavemesh/codec.h>

#include <cstdio>
#include <tuple>

namespace {

using namespace wavemesh;

std::uint64_t hashOf(const void* data, std::size_t size, std::uint64_t h = 0xcbf29ce484222325u)
{
	for (std::size_t i = 0; i < size; ++i)
		h = (h ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
	return h;
}

std::uint64_t hashOf(const MeshData& m)
{
	std::uint64_t h = 0;
	for (const auto& p : m.positions)
		h = hashOf(p.data(), sizeof p, h);
	for (const auto& t : m.triangles)
		h = hashOf(t.data(), sizeof t, h);
	return h;
}

bool print(const char* name, const MeshData& mesh, const EncodeOptions& o)
{
	const auto file = encode(mesh, o);
	if (!file.ok())
		return false;
	const auto back = decode(file->bytes.data(), file->bytes.size());
	if (!back.ok())
		return false;
	std::printf(
	    "%s mode %d effort %d bits %d lifting %d wgc %d optimize %d: %zu bytes %016llx mesh "
	    "%016llx\n",
	    name, int(o.mode), o.effort, o.bits, o.lifting, int(o.wgc), int(o.optimize),
	    file->bytes.size(),
	    static_cast<unsigned long long>(hashOf(file->bytes.data(), file->bytes.size())),
	    static_cast<unsigned long long>(hashOf(back->mesh)));
	return true;
}

} // namespace

int main()
{
	const test::NamedMesh meshes[] = {
	    {"bumpy_sphere", test::makeBumpySphere(900, 1)},
	    {"star_prism", test::makeStarPrism(12, 10)},
	    {"terrain", test::makeTerrain(700, 2)},
	    {"noisy", test::jittered(test::makeFlippedSphere(400, 3), 0.25, 4)},
	    {"holed_plate", test::makeHoledPlate(2, 4)},
	    {"far_away", test::moved(test::makeBumpySphere(300, 5), 1e5, -2e5, 3e5)},
	};
	for (const auto& m : meshes) {
		for (int lifting = kLiftingOff; lifting <= 2; ++lifting) {
			EncodeOptions o;
			o.bits     = 12 + 2 * lifting;
			o.lifting  = lifting;
			o.wgc      = lifting == kLiftingOff ? Wgc::Off : Wgc::On;
			o.optimize = lifting % 2 == 0 ? Optimize::Size
			             : lifting == 1   ? Optimize::Balanced
			                              : Optimize::Levels;
			o.effort   = lifting == 0 ? 1 : 2;
			o.mode     = Mode::Classic;
			if (!print(m.name.c_str(), m.mesh, o))
				return 1;
		}
		for (const auto& [effort, bits, optimize] :
		     {std::tuple {2, 12, Optimize::Balanced}, std::tuple {2, 16, Optimize::Size},
		      std::tuple {2, 20, Optimize::Levels}, std::tuple {3, 18, Optimize::Levels},
		      std::tuple {3, 12, Optimize::Size}}) {
			EncodeOptions o;
			o.mode     = Mode::Compact;
			o.effort   = effort;
			o.bits     = bits;
			o.optimize = optimize;
			if (effort == 3 && optimize == Optimize::Size && m.mesh.positions.size() > 500)
				continue; // tried in dozens of ways, at -O0 too
			if (!print(m.name.c_str(), m.mesh, o))
				return 1;
		}
	}
	return 0;
}
