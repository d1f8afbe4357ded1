// A row of posts under a beam: the beam is too low, and the brace is in the last post.
// keep: collisions = false
count = 4;
pitch = 60;
high = 80;

for (i = [0:count - 1]) translate([i * pitch, 0, 0]) cube([12, 12, high]);
translate([-10, -2, 76]) cube([220, 16, 14]);
translate([150, 2, 20]) rotate([0, 30, 0]) cube([40, 8, 8]);
