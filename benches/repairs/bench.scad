// A bench between two planters, one of which it touches. z is up.
// keep: collisions = false
// keep: within = [[0, 0, 0], [2700, 800, 900]]
length = 1500;   // of the seat
left = 300;      // where the seat begins

module planter(x) {
    translate([x, 100, 0]) cube([500, 500, 600]);
}

translate([left, 150, 400]) cube([length, 400, 40]);
for (i = [0:1]) translate([left + 100 + i * 1200, 180, 0]) cube([80, 340, 400]);
planter(0);
planter(1850);
