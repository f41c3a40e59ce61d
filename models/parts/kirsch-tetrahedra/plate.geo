// Quarter of a plate of 40 x 40 mm with a round hole of radius 1 mm; half of its thickness of 0.4 mm. In millimetres.
SetFactory("OpenCASCADE");
w = 20; t = 0.2; eps = 1e-3;
Box(1) = {0, 0, 0, w, w, t};
Cylinder(2) = {0, 0, -t, 0, 0, 3 * t, 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMax = 4;
Mesh.MeshSizeFromCurvature = 12;   // elements a full turn
Physical Volume("plate") = {3};
Physical Surface("middle") = Surface In BoundingBox{-eps, -eps, -eps, w + eps, w + eps, eps};
Physical Surface("on x") = Surface In BoundingBox{-eps, -eps, -eps, w + eps, eps, t + eps};
Physical Surface("on y") = Surface In BoundingBox{-eps, -eps, -eps, eps, w + eps, t + eps};
Physical Surface("end") = Surface In BoundingBox{w - eps, -eps, -eps, w + eps, w + eps, t + eps};
