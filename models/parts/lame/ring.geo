// Quarter of a ring, radii 10 and 20 mm, 5 mm thick. In millimetres. Tetrahedra.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 5, 20, Pi / 2};
Cylinder(2) = {0, 0, 0, 0, 0, 5, 10, Pi / 2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMax = 1.6;
eps = 1e-3;
Physical Volume("ring") = {3};
Physical Surface("bottom") = Surface In BoundingBox{-eps, -eps, -eps, 20 + eps, 20 + eps, eps};
Physical Surface("top") = Surface In BoundingBox{-eps, -eps, 5 - eps, 20 + eps, 20 + eps, 5 + eps};
Physical Surface("on x") = Surface In BoundingBox{-eps, -eps, -eps, 20 + eps, eps, 5 + eps};
Physical Surface("on y") = Surface In BoundingBox{-eps, -eps, -eps, eps, 20 + eps, 5 + eps};
Physical Surface("bore") = Surface In BoundingBox{-eps, -eps, -eps, 10 + eps, 10 + eps, 5 + eps};
