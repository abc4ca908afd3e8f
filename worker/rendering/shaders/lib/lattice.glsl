// Where on a lattice a place lies: a cell, from 0 on, and how far in it, 0..1.
struct LatticePlace {
    int cell;
    float offset;
};

// A place in tiles, on a lattice of fewer than 2^19 cells per tile, moved on by a part of a cell.
// The product is taken in two halves, so that it keeps as many digits as the place has.
LatticePlace lattice_place(float place, int cells, float shift) {
    float coarse = floor(place * 4096.0);
    float fine = place - coarse / 4096.0;
    int whole = int(coarse - 4096.0 * floor(coarse / 4096.0)) * cells;
    float offset = float(whole & 4095) / 4096.0 + (fine * float(cells) + shift);
    float up = floor(offset);
    return LatticePlace((whole >> 12) + int(up), offset - up);
}
