"""What the techniques share that make new texture from old.

They all find, for each new pixel, a pixel of an exemplar to copy: a coordinate map. They match in
an 8-bit feature space near to what an eye sees, and copy from the original picture at the end, so
that light beyond 1, 16 bits and alpha stay as they were. A map has shape (height, width, 2) and
holds the row and the column of the source pixel.
"""
