// The library sward_maps (map_reader.h).
#include "terrain/maps/map_reader.h"

extern "C" __attribute__((visibility("default"))) const sward::terrain::MapReader*
sward_map_reader_3()
{
    static const sward::terrain::MapReader reader{
        &sward::terrain::readMapByGdal, &sward::terrain::openMapByGdal,
        &sward::terrain::readShapesByGdal, &sward::terrain::mapSystemFactsByGdal,
        &sward::terrain::changedPlacesByGdal};
    return &reader;
}
