// Parts on a printer's plate: a ring leaves it, and two of them lie on one another.
// keep: collisions = false
// keep: within = [[0, 0, 0], [200, 200, 100]]
$fn = 32;

module ring(r, h) {
    difference() {
        cylinder(h = h, r = r);
        translate([0, 0, -1]) cylinder(h = h + 2, r = r - 4);
    }
}

translate([40, 40, 0]) ring(30, 12);
translate([95, 50, 0]) ring(30, 12);
translate([175, 60, 0]) ring(28, 20);  // too near to the edge
translate([20, 100, 0]) cube([70, 60, 15]);
translate([80, 110, 0]) cube([60, 60, 15]);
