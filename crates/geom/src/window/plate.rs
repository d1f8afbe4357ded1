//! A page over the rays of a picture.
