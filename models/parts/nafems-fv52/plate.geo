// Plate 10 x 10 x 1 m.
Point(1) = {0, 0, 0};
Point(2) = {10, 0, 0};
Point(3) = {10, 10, 0};
Point(4) = {0, 10, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 9;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude{0, 0, 1}{ Surface{1}; Layers{2}; Recombine; };
Physical Volume("plate") = {out[1]};
Physical Surface("sides along x") = {out[2], out[4]};
Physical Surface("sides along y") = {out[3], out[5]};
