// Pieces of work on a processor, each for one work-item. A runtime may hand half of all items to
// one thread at once, and the other thread, or a faster core, takes none of these over. So a piece
// comes with several items (Launch::run_pieces), of which only the first has work to do.
#define NO_PIECE 0xffffffffu

static inline uint piece_of_item(uint pieces) {
  const uint items = (uint)get_global_size(0) / pieces, item = (uint)get_global_id(0);
  return item % items == 0 ? item / items : NO_PIECE;
}
